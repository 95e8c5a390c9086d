//! Reports: one HTML file that shows everything, offline, without a server.

pub(crate) mod animation;
mod data;

use std::path::Path;

pub use animation::{Animation, Readout};

use crate::figure::{Content, Figure};
use crate::html::{DRAWING_SCRIPT, SHAPES_SCRIPT, UPLOT_SCRIPT, UPLOT_STYLE, escaped, escaped_json, filled};
use crate::{Error, Table, files};

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// A report: a title, an introduction and sections.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// The title.
    pub title: String,
    /// The introduction, a paragraph.
    pub lead: String,
    /// The sections, in order.
    pub sections: Vec<Section>,
}

/// A section of a report.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Its heading.
    pub heading: String,
    /// Its contents, in order.
    pub blocks: Vec<Block>,
}

/// A part of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A paragraph of plain text.
    Text(String),
    /// A figure: curves can be zoomed and read off, maps are pictures.
    Figure {
        /// The figure.
        figure: Figure,
        /// The caption.
        caption: String,
        /// Files with the same content, to be linked.
        files: Vec<String>,
    },
    /// A table.
    Table(Table),
    /// A moving picture of a mechanism.
    Animation(Animation),
}

impl Section {
    /// An empty section.
    pub fn new(heading: impl Into<String>) -> Self {
        Self { heading: heading.into(), blocks: Vec::new() }
    }

    /// With one more block.
    #[must_use]
    pub fn with(mut self, block: Block) -> Self {
        self.blocks.push(block);
        self
    }

    /// With one more paragraph.
    #[must_use]
    pub fn text(self, text: impl Into<String>) -> Self {
        self.with(Block::Text(text.into()))
    }
}

impl Report {
    /// The report as one HTML page without references to anything outside it,
    /// except links to the files that figures name.
    ///
    /// # Errors
    /// [`Error::Figure`] if a picture cannot be drawn.
    pub fn html(&self) -> Result<String, Error> {
        let mut plots = Vec::new();
        let mut body = String::new();
        for (number, section) in self.sections.iter().enumerate() {
            body += &format!("<section id=\"s{number}\">\n<h2>{}</h2>\n", escaped(&section.heading));
            for block in &section.blocks {
                body += &self::block(block, &mut plots)?;
            }
            body += "</section>\n";
        }
        let contents =
            self.sections.iter().enumerate().map(|(number, section)| {
                format!("<a href=\"#s{number}\">{}</a>\n", escaped(&section.heading))
            });
        let parts = [
            ("TITLE", escaped(&self.title)),
            ("LEAD", escaped(&self.lead)),
            ("CONTENTS", contents.collect()),
            ("BODY", body),
            ("DATA", escaped_json(&serde_json::Value::Array(plots))),
            ("STYLE", format!("{UPLOT_STYLE}\n{STYLE}")),
            ("SCRIPT", format!("{UPLOT_SCRIPT}\n{DRAWING_SCRIPT}\n{SHAPES_SCRIPT}\n{SCRIPT}")),
        ];
        Ok(filled(PAGE, &parts.each_ref().map(|(name, part)| (*name, part.as_str()))))
    }

    /// Writes the page to a file.
    ///
    /// # Errors
    /// [`Error::Figure`], [`Error::File`].
    pub fn save(&self, path: &Path) -> Result<(), Error> {
        files::write(path, self.html()?.as_bytes())
    }
}

fn block(block: &Block, plots: &mut Vec<serde_json::Value>) -> Result<String, Error> {
    Ok(match block {
        Block::Text(text) => format!("<p>{}</p>\n", escaped(text)),
        Block::Table(table) => html_table(table),
        Block::Animation(animation) => {
            plots.push(animation.data());
            format!("<figure class=\"animation\" data-plot=\"{}\"></figure>\n", plots.len() - 1)
        }
        Block::Figure { figure, caption, files } => html_figure(figure, caption, files, plots)?,
    })
}

fn html_figure(
    figure: &Figure,
    caption: &str,
    files: &[String],
    plots: &mut Vec<serde_json::Value>,
) -> Result<String, Error> {
    let mut html = String::from("<figure>\n");
    if figure.panels.iter().any(|panel| !matches!(panel.content, Content::Lines(_))) {
        let svg = figure.svg()?;
        // Only the element itself: an XML declaration has no place inside a page.
        html += svg.find("<svg").map_or("", |at| &svg[at..]);
        html += "\n";
    } else {
        // The picture of a map has the title in it.
        html += &format!("<h3>{}</h3>\n", escaped(&figure.title));
        for panel in &figure.panels {
            plots.push(data::panel(panel));
            html += &format!("<div class=\"plot\" data-plot=\"{}\"></div>\n", plots.len() - 1);
        }
    }
    let links = files.iter().map(|file| {
        let ending = file.rsplit('.').next().unwrap_or("file").to_uppercase();
        format!(" <a href=\"{}\">{}</a>", escaped(file), escaped(&ending))
    });
    html += &format!("<figcaption>{}{}</figcaption>\n", escaped(caption), links.collect::<String>());
    Ok(html + "</figure>\n")
}

fn html_table(table: &Table) -> String {
    let line = |cells: &[String], tag: &str| {
        let cells = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell)));
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let rows = table.rows().iter().map(|row| line(row, "td"));
    format!(
        "<div class=\"scroll\"><table>\n<thead>{}</thead>\n<tbody>\n{}</tbody>\n</table></div>\n",
        line(table.headings(), "th"),
        rows.collect::<String>()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::{Axis, HeatMap, Panel, Series};
    use crate::picture::{Picture, Shape};

    #[test]
    fn a_page_that_needs_nothing_else() {
        let series = Series::new("</script>", [[0.0, 1e-8], [1.0, f64::NAN]]);
        let panel = Panel::lines(Axis::new("t", "s"), Axis::new("y", ""), [series]);
        let mut table = Table::new(["a < b"]);
        table.row(["1 & 2"]);
        let report = Report {
            title: "Test".into(),
            lead: "What it is.".into(),
            sections: vec![Section::new("One").text("Text.").with(Block::Table(table)).with(Block::Figure {
                figure: Figure::new("F").panel(panel),
                caption: "c".into(),
                files: vec!["f.csv".into()],
            })],
        };
        let html = report.html().unwrap();
        assert!(html.contains("a &lt; b") && html.contains("1 &amp; 2") && html.contains("f.csv"));
        assert!(html.contains(r"\u003c/script\u003e") && html.contains("1e-8") && html.contains("null"));
        assert!(!html.contains("@BODY@") && !html.contains("@DATA@"));
        assert!(!html.contains("src=\"http") && !html.contains("href=\"http"));
    }

    const HOSTILE: [&str; 6] = [
        "<img src=x onerror=\"document.documentElement.dataset.seized=1\">",
        "</script><script>document.documentElement.dataset.seized=2</script>",
        "<!--<script>",
        "</title></style></svg><svg onload='document.documentElement.dataset.seized=3'>",
        "@DATA@ @BODY@ @SCRIPT@",
        "\u{2028}&lt;\"'`${1}\\",
    ];

    /// A page in which every text that somebody else can choose is hostile.
    fn hostile() -> Report {
        let all = HOSTILE.join(" ");
        let axis = || Axis::new(all.clone(), all.clone());
        let curves = || [0.0, 1.0].map(|y| Series::new(all.clone(), [[0.0, y], [1.0, 2.0]]));
        let map =
            HeatMap { x: vec![0.0, 1.0], y: vec![0.0, 1.0], values: vec![0.0, 1.0, 2.0, 3.0], scale: axis() };
        let figure = |panel: Panel| Block::Figure {
            figure: Figure::new(all.clone()).panel(panel),
            caption: all.clone(),
            files: vec![all.clone()],
        };
        let picture = Picture {
            times: vec![0.0, 1.0],
            points: vec![vec![[0.0, 0.0], [1.0, 1.0]]; 2],
            shapes: vec![
                Shape::Mark { between: [0, 1], text: all.clone() },
                Shape::Label { text: all.clone(), near: vec![0, 1], colour: 0 },
            ],
            weight: 1.0,
            ..Picture::default()
        };
        let readouts = vec![Readout { name: all.clone(), unit: all.clone(), values: vec![0.0, 1.0] }];
        let mut table = Table::new([all.clone()]);
        table.row([all.clone()]);
        let section = Section::new(all.clone())
            .text(all.clone())
            .with(Block::Table(table))
            .with(figure(Panel::lines(axis(), axis(), curves())))
            .with(figure(Panel::map(axis(), axis(), map)))
            .with(figure(Panel::mechanism(picture.clone())))
            .with(Block::Animation(Animation { title: all.clone(), picture, readouts }));
        Report { title: all.clone(), lead: all.clone(), sections: vec![section] }
    }

    /// `@DATA@` in a comment was replaced by the data, and names ran as scripts.
    #[test]
    fn texts_of_others_stay_texts() {
        let html = hostile().html().unwrap();
        // Nothing but the page's own elements, each where it was.
        let benign = Report { title: "t".into(), lead: "l".into(), sections: Vec::new() }.html().unwrap();
        let count = |html: &str, what: &str| html.matches(what).count();
        for part in ["<script", "</script", "<!--", "<title", "</title", "</style", "onerror=\"", "<img"] {
            assert_eq!(count(&html, part), count(&benign, part), "{part}");
        }
        assert!(count(&html, "@DATA@ @BODY@ @SCRIPT@") > 10);
        let begin = html.find("id=\"data\">").unwrap() + 10;
        let data = &html[begin..begin + html[begin..].find("</script>").unwrap()];
        let plots: serde_json::Value = serde_json::from_str(data).unwrap();
        assert_eq!(plots[0]["series"][0]["name"], HOSTILE.join(" "));
    }

    /// The same in a browser, where there is one.
    #[test]
    fn a_browser_runs_no_script_but_the_pages_own() {
        let folder = tempfile::tempdir().unwrap();
        let page = folder.path().join("page.html");
        hostile().save(&page).unwrap();
        let dump = |browser: &&str| {
            std::process::Command::new(browser)
                .args([
                    "--headless",
                    "--no-sandbox",
                    "--disable-gpu",
                    "--virtual-time-budget=2000",
                    "--dump-dom",
                ])
                .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
                .arg(format!("file://{}", page.display()))
                .output()
                .ok()
        };
        let browsers = ["chromium", "chromium-browser", "google-chrome"];
        let Some(dom) = browsers.iter().find_map(dump) else {
            eprintln!("skipped: there is none of {browsers:?}");
            return;
        };
        let dom = String::from_utf8_lossy(&dom.stdout);
        assert!(!dom.contains("data-seized"), "a name ran as a script");
        assert!(dom.contains("class=\"uplot") && dom.contains("class=\"readouts\"><span>"), "{dom}");
    }
}
