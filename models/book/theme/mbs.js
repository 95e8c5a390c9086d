// The colours of declarations: a language for highlight.js, which the pages carry.
(() => {
    // the words that begin a statement, from the compiler; elsewhere they may be names
    const statements = "KEYWORDS".replaceAll(" ", "|");
    const begin = new RegExp(`(?<=(?:^|[;{}])\\s*)(?:pub|${statements})\\b`);
    hljs.registerLanguage("mbs", (hljs) => ({
        keywords: {keyword: "where on in at along radius teeth carrier guess rising falling offset", built_in: "ground"},
        contains: [
            hljs.COMMENT("//", "$"),
            {className: "keyword", begin},
            {className: "type", begin: /\b[A-Z]\w*(?=\s*\{)/},
            // a unit, or an index
            {className: "symbol", begin: /\[[^\]\n]*\]/},
            {className: "number", begin: /\b\d+(\.\d+)?(e[+-]?\d+)?/},
        ],
    }));
    document.querySelectorAll("code.language-mbs").forEach((block) => hljs.highlightBlock(block));
})();
