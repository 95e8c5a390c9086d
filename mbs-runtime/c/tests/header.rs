//! Header and library are held together: functions, their arguments with names and types, structs, numbers, symbols.
#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use std::path::{Path, PathBuf};
use std::process::Command;

const HEADER: &str = include_str!("../include/mbs.h");
const EXPORTS: &str = include_str!("../src/exports.rs");

/// A function: its name, its arguments with names and types, and what it returns.
#[derive(Debug, PartialEq)]
struct Function {
    name: String,
    arguments: Vec<(String, String)>,
    result: String,
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The header without comments.
fn code() -> String {
    let mut parts = HEADER.split("/*");
    let first = parts.next().expect("a part").to_owned();
    parts.fold(first, |code, part| code + part.split_once("*/").expect("a comment that ends").1)
}

/// The functions that the header declares.
fn declared() -> Vec<Function> {
    let code = code();
    let declarations = code.split("\nMBS_API ").skip(1);
    let function = |text: &str| {
        let (head, rest) = text.split_once('(').expect("arguments");
        let arguments = words(rest.split(')').next().expect("an end"));
        let (head, name) = words(head)
            .rsplit_once("mbs_")
            .map(|(head, name)| (head.to_owned(), format!("mbs_{name}")))
            .expect("a name");
        let argument = |text: &str| {
            let at = text.rfind(|letter: char| !(letter.is_alphanumeric() || letter == '_')).expect("a type");
            (text[at + 1..].to_owned(), text[..=at].trim().to_owned())
        };
        let arguments = match arguments.as_str() {
            "void" => Vec::new(),
            some => some.split(',').map(|text| argument(text.trim())).collect(),
        };
        Function { name, arguments, result: head.trim().to_owned() }
    };
    declarations.map(function).collect()
}

/// The functions that the library exports.
fn exported() -> Vec<Function> {
    let function = |text: &str| {
        let (name, rest) = text.split_once('(').expect("arguments");
        let (arguments, rest) = rest.split_once(") ").expect("a body");
        let argument = |text: &str| {
            let (name, kind) = text.split_once(": ")?;
            Some((name.trim().to_owned(), kind.trim().to_owned()))
        };
        // the comma in `Out<'_, f64>` divides nothing
        let arguments = words(arguments).replace("'_, ", "'_ ");
        let arguments = arguments.split(',').filter_map(argument).collect();
        let result =
            rest.strip_prefix("-> ").map_or("c_int", |rest| rest.split(" {").next().expect("a result"));
        Function { name: format!("mbs_{name}"), arguments, result: result.to_owned() }
    };
    EXPORTS.split("fn mbs_").skip(1).map(function).collect()
}

/// The types of Rust that a type of C may be.
fn types(c: &str) -> &'static [&'static str] {
    match c {
        "void" => &["()"],
        "double" => &["f64"],
        "size_t" => &["usize"],
        "uint32_t" => &["u32"],
        "uint64_t" => &["u64"],
        // an enumeration of C is an int, or an unsigned one, which is passed alike
        "mbs_status" => &["c_int"],
        "mbs_kind" => &["c_int"],
        "const char *" => &["Text<'_>", "*const c_char"],
        "const char **" => &["Out<'_ *const c_char>"],
        "const double *" => &["Numbers<'_>"],
        "double *" => &["Out<'_ f64>", "NumbersOut<'_>"],
        "size_t *" => &["Out<'_ usize>"],
        "int32_t *" => &["Out<'_ i32>"],
        "mbs_problem *" => &["Out<'_ Problem>"],
        "mbs_quantity *" => &["Out<'_ Quantity>"],
        "const mbs_mechanism *" => &["Shared<'_ Mechanism>"],
        "mbs_mechanism *" => &["Owned<Mechanism>"],
        "mbs_mechanism **" => &["Out<'_ *mut Mechanism>"],
        "const mbs_run *" => &["Shared<'_ Run>"],
        "mbs_run *" => &["Exclusive<'_ Run>", "Owned<Run>"],
        "mbs_run **" => &["Out<'_ *mut Run>"],
        other => panic!("the type `{other}` is not known here"),
    }
}

#[test]
fn functions_have_the_arguments_of_the_header() {
    let (mut declared, mut exported) = (declared(), exported());
    assert_eq!(declared.len(), 35);
    for functions in [&mut declared, &mut exported] {
        functions.sort_by(|a, b| a.name.cmp(&b.name));
    }
    let names =
        |functions: &[Function]| -> Vec<String> { functions.iter().map(|it| it.name.clone()).collect() };
    assert_eq!(names(&declared), names(&exported));
    for (c, rust) in declared.iter().zip(&exported) {
        assert!(types(&c.result).contains(&rust.result.as_str()), "{c:?}\n{rust:?}");
        assert_eq!(c.arguments.len(), rust.arguments.len(), "{c:?}\n{rust:?}");
        for ((name, of_c), (same, of_rust)) in c.arguments.iter().zip(&rust.arguments) {
            assert_eq!(name, same, "{}", c.name);
            assert!(types(of_c).contains(&of_rust.as_str()), "{}: {name} is {of_c} and {of_rust}", c.name);
        }
    }
}

/// The names and numbers of an enumeration of the header.
fn numbers(name: &str) -> Vec<(String, i32)> {
    let code = code();
    let body = code.split(&format!("typedef enum {name} {{")).nth(1).and_then(|rest| rest.split('}').next());
    let entry = |text: &str| {
        let (name, number) = text.split_once('=').expect("a number");
        (name.trim().trim_start_matches("MBS_").to_owned(), number.trim().parse().expect("a number"))
    };
    body.expect("an enumeration").split(',').map(entry).collect()
}

/// `OutOfReach` as `OUT_OF_REACH`.
fn capitals(name: &str) -> String {
    let letter = |(at, letter): (usize, char)| {
        let between = if at > 0 && letter.is_uppercase() { "_" } else { "" };
        format!("{between}{}", letter.to_uppercase())
    };
    name.char_indices().map(letter).collect()
}

#[test]
fn numbers_are_those_of_the_header() {
    let source = include_str!("../src/status.rs");
    let body = source
        .split("pub enum Status {")
        .nth(1)
        .and_then(|rest| rest.split('}').next())
        .expect("it is there");
    let status = |text: &str| {
        let (name, number) = text.split_once(" = ")?;
        Some((capitals(name.trim()), number.parse().ok()?))
    };
    let found: Vec<(String, i32)> = body.split(',').filter_map(|text| status(text.trim())).collect();
    assert_eq!(numbers("mbs_status"), found);

    let source = include_str!("../src/mechanism.rs");
    let body =
        source.split("pub enum Kind {").nth(1).and_then(|rest| rest.split('}').next()).expect("it is there");
    let kinds: Vec<_> =
        body.split(',').map(str::trim).filter(|name| !name.is_empty()).map(capitals).collect();
    let kinds: Vec<(String, i32)> = kinds.into_iter().zip(1..).collect();
    assert_eq!(numbers("mbs_kind"), kinds);

    assert!(HEADER.contains("#define MBS_ABI 1\n") && EXPORTS.contains("const ABI: u32 = 1;\n"));
}

/// The fields of a struct, with their types.
fn fields(
    source: &str,
    begin: &str,
    field: impl Fn(&str) -> Option<(String, String)>,
    between: char,
) -> Vec<(String, String)> {
    let body = source.split(begin).nth(1).and_then(|rest| rest.split('}').next()).expect("a struct");
    let lines: String = body.lines().filter(|line| !line.trim().starts_with("//")).collect();
    lines.split(between).filter_map(|text| field(text.trim())).collect()
}

#[test]
fn structs_have_the_fields_of_the_header() {
    let c = |text: &str| {
        let at = text.rfind([' ', '*'])?;
        let kind = match text[..=at].trim() {
            "const char *" => "*const c_char",
            "double" => "f64",
            "size_t" => "usize",
            other => panic!("{other}"),
        };
        Some((text[at + 1..].to_owned(), kind.to_owned()))
    };
    let rust = |text: &str| {
        let (name, kind) = text.trim_start_matches("pub ").split_once(": ")?;
        Some((name.to_owned(), kind.to_owned()))
    };
    let sources = [
        ("mbs_quantity", "Quantity", include_str!("../src/mechanism.rs")),
        ("mbs_problem", "Problem", include_str!("../src/last.rs")),
    ];
    for (of_c, of_rust, source) in sources {
        let declared = fields(&code(), &format!("typedef struct {of_c} {{"), c, ';');
        let found = fields(source, &format!("#[repr(C)]\npub struct {of_rust} {{"), rust, ',');
        assert!(declared.len() == 5 && declared == found, "{declared:?}\n{found:?}");
    }
}

/// The shared library that cargo made for this test.
fn library() -> PathBuf {
    let test = std::env::current_exe().expect("a test");
    let (prefix, suffix) = (std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    test.parent().unwrap_or(Path::new(".")).join(format!("{prefix}mbs{suffix}"))
}

#[test]
fn symbols_of_the_library_are_the_functions_of_the_header() {
    let symbols = Command::new("nm").args(["-D", "--defined-only"]).arg(library()).output();
    let symbols = match symbols {
        Ok(symbols) if cfg!(target_os = "linux") => symbols,
        _ => return eprintln!("skipped: there is no `nm` for the libraries of this machine"),
    };
    assert!(symbols.status.success(), "{}", String::from_utf8_lossy(&symbols.stderr));
    let text = String::from_utf8(symbols.stdout).expect("ASCII");
    let mut found: Vec<_> = text.lines().filter_map(|line| line.split_whitespace().last()).collect();
    found.sort_unstable();
    let mut declared: Vec<_> = declared().into_iter().map(|function| function.name).collect();
    declared.sort();
    assert_eq!(found, declared);
}
