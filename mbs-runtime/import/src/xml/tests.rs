use super::*;

fn fault(text: &str) -> String {
    Document::parse(text).err().map(|refusal| refusal.0).unwrap_or_default()
}

#[test]
fn elements_attributes_and_texts_are_read() {
    let text = "<?xml version='1.0'?><!DOCTYPE a [<!ENTITY b '>'>]>\n<a x='1' y=\"&lt;&#65;&#x42;\">\n \
                <b>1 <!-- one --> 2<![CDATA[ & 3]]></b><gz:c/>\n<b name='second'/></a>\n";
    let document = Document::parse(text).unwrap();
    let root = document.root();
    assert_eq!((root.name(), root.attribute("x"), root.attribute("y")), ("a", Some("1"), Some("<AB")));
    let names: Vec<_> = root.elements().map(Node::name).collect();
    assert_eq!(names, ["b", "gz:c", "b"]);
    let all: Vec<_> = root.elements_named("b").map(|node| (node.text(), node.described("b"))).collect();
    let second = (None, "the b `second` (line 4)".to_owned());
    assert_eq!(all, [(Some("1  2 & 3"), "the b in line 3".to_owned()), second]);
}

/// Each of these was "no complete XML", and the programs whose files they are read them.
#[test]
fn what_programs_write_against_the_standard_is_read() {
    for (text, value) in [
        ("<!-- 2020 -- by hand --><a x='1'/>", "1"),
        ("<a x='1'y='2'/>", "1"),
        ("<a drake:y='2' x='1'><drake:b/></a>", "1"),
        ("<a x='this & that'/>", "this & that"),
        ("<a x = '1' ></a >", "1"),
    ] {
        let document = Document::parse(text).unwrap();
        assert_eq!(document.root().attribute("x"), Some(value), "{text}");
    }
}

#[test]
fn faults_name_the_line_and_what_is_wrong() {
    for (text, message) in [
        ("", "line 1: it has no element"),
        ("text<a/>", "line 1: there is text outside of its root"),
        ("<a/>\n<b/>", "line 2: `b` is a second root"),
        ("<a>\n<b></a>", "line 2: `a` ends before the b in line 2"),
        ("<a>\n", "line 2: the a in line 1 does not end"),
        ("<a/></a>", "line 1: `a` ends and did not begin"),
        ("<a x='1'\n x='2'/>", "line 2: `a` has the attribute `x` twice"),
        ("<a x=1/>", "line 1: the attribute `x` of `a` has no value in quotes"),
        ("<a x='1/><b/>", "line 1: the value of `x` does not end"),
        ("<a <b/>", "line 1: the element `a` does not end with `>`"),
        ("<a>1 < 2</a>", "line 1: `<` begins no element; in a text it is written `&lt;`"),
        ("<a><!-- </a>", "line 1: the comment does not end"),
        ("<!DOCTYPE a [", "line 1: the declaration does not end"),
        ("<a></a", "line 1: the end of `a` has no `>`"),
        (
            "<a>&#0;</a>",
            "line 1: `&#0;` stands for nothing here; what a document declares itself is not expanded",
        ),
    ] {
        assert_eq!(fault(text), format!("it is no complete XML: {message}"), "{text}");
    }
}

/// Ten entities of ten entities each, nine deep, were a billion letters.
#[test]
fn entities_that_a_document_declares_are_not_expanded() {
    let bomb = "<!DOCTYPE a [<!ENTITY x 'xxxxxxxxxx'><!ENTITY y '&x;&x;&x;&x;&x;'>]><a>&y;</a>";
    assert!(fault(bomb).contains("`&y;` stands for nothing here"), "{}", fault(bomb));
}

#[test]
fn elements_that_nest_too_deeply_are_refused() {
    let nested = |deep: usize| format!("{}{}", "<a>".repeat(deep), "</a>".repeat(deep));
    assert_eq!(fault(&nested(DEEPEST)), "");
    assert!(fault(&nested(DEEPEST + 1)).contains("nested more than 1000 deep"));
    assert!(fault(&"<a>".repeat(1_000_000)).contains("nested more than 1000 deep"));
}

/// The reader looked up each attribute among all others: this took minutes.
#[test]
fn elements_may_have_many_attributes() {
    let many: String = (0..100_000).map(|at| format!(" a{at}='{at}'")).collect();
    let text = format!("<a{many}/>");
    let document = Document::parse(&text).unwrap();
    assert_eq!(document.root().attribute("a99999"), Some("99999"));
    assert!(fault(&format!("<a{many} a5=''/>")).contains("the attribute `a5` twice"));
}
