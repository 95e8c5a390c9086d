use super::*;

fn sheet_of(bytes: &[u8]) -> Result<Sheet, Error> {
    read_at(&tempfile::tempdir().unwrap().path().join("log.csv"), bytes)
}

fn read_at(path: &Path, bytes: &[u8]) -> Result<Sheet, Error> {
    std::fs::write(path, bytes).unwrap();
    Sheet::read(path)
}

fn message(text: &str) -> String {
    let error = match sheet_of(text.as_bytes()) {
        Err(error) => error,
        Ok(sheet) => {
            let read = |text: &str| quantity::parse("x", text, mbs_runtime::Dimension::of(0, 1, 0));
            sheet.values(&sheet.columns[0], read).unwrap_err()
        }
    };
    error.to_string()
}

/// The form in which a program writes a table of the time in ms and an angle in degrees.
#[derive(Clone, Copy, Debug)]
struct Dialect {
    separator: char,
    decimal: char,
    /// Headings of time and angle, and a row of units.
    headings: ([&'static str; 2], Option<[&'static str; 2]>),
    comment: Comment,
    encoding: Encoding,
    is_time_first: bool,
    line_end: &'static str,
}

#[derive(Clone, Copy, Debug)]
enum Comment {
    None,
    Before(&'static str),
    Between(&'static str),
    /// The headings themselves are one.
    Headings,
}

#[derive(Clone, Copy, Debug)]
enum Encoding {
    Utf8,
    Utf8WithMark,
    Utf16Little,
    Utf16Big,
    Windows1252,
}

const NUMBERS: [[f64; 2]; 3] = [[0.5, -1.25], [1.5, 2e-3], [1000.0, 3.0]];

impl Dialect {
    fn line(&self, mut cells: [String; 2]) -> String {
        if !self.is_time_first {
            cells.reverse();
        }
        cells.join(&self.separator.to_string()) + self.line_end
    }

    fn write(&self) -> Vec<u8> {
        let (headings, units) = self.headings;
        let mut text = String::new();
        match self.comment {
            Comment::Before(sign) => text += &format!("{sign} a log{}", self.line_end),
            Comment::Headings => text += "# ",
            _ => {}
        }
        text += &self.line(headings.map(str::to_owned));
        if let Some(units) = units {
            text += &self.line(units.map(str::to_owned));
        }
        for (at, row) in NUMBERS.iter().enumerate() {
            if let (1, Comment::Between(sign)) = (at, self.comment) {
                text += &format!("{sign} paused{}", self.line_end);
            }
            text += &self.line(row.map(|x| format!("{x:?}").replace('.', &self.decimal.to_string())));
        }
        let utf16 = || std::iter::once('\u{feff}').chain(text.chars()).collect::<String>();
        match self.encoding {
            Encoding::Utf8 => text.into_bytes(),
            Encoding::Utf8WithMark => format!("\u{feff}{text}").into_bytes(),
            Encoding::Utf16Little => utf16().encode_utf16().flat_map(u16::to_le_bytes).collect(),
            Encoding::Utf16Big => utf16().encode_utf16().flat_map(u16::to_be_bytes).collect(),
            Encoding::Windows1252 => text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect(),
        }
    }
}

fn dialects() -> Vec<Dialect> {
    let headings = [
        (["t [ms]", "phi [deg]"], None),
        (["Time (ms)", "phi (°)"], None),
        (["t(ms)", "phi[°]"], None),
        (["time_ms", "phi (deg)"], None),
        (["elapsed [ms]", "phi [degrees]"], None),
        (["t", "phi"], Some(["ms", "deg"])),
        (["TIME", "phi"], Some(["[ms]", "(°)"])),
        (["Run Time", "phi"], Some(["ms", "deg"])),
    ];
    let comments = [
        Comment::None,
        Comment::Before("#"),
        Comment::Before("%"),
        Comment::Between("#"),
        Comment::Between("  %"),
        Comment::Headings,
    ];
    let encodings = [
        Encoding::Utf8,
        Encoding::Utf8WithMark,
        Encoding::Utf16Little,
        Encoding::Utf16Big,
        Encoding::Windows1252,
    ];
    let mut all = Vec::new();
    for (separator, decimal) in [(',', '.'), (',', ','), (';', '.'), (';', ','), ('\t', '.'), ('\t', ',')] {
        for headings in headings {
            for comment in comments {
                for encoding in encodings {
                    for (is_time_first, line_end) in [(true, "\n"), (false, "\r\n")] {
                        all.push(Dialect {
                            separator,
                            decimal,
                            headings,
                            comment,
                            encoding,
                            is_time_first,
                            line_end,
                        });
                    }
                }
            }
        }
    }
    all
}

/// Every dialect gives the same numbers, or an error that names the cause.
#[test]
fn dialects_are_read_or_refused_with_the_cause() {
    let (mut read, mut refused) = (0, 0);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log.csv");
    for dialect in dialects() {
        let found = read_at(&path, &dialect.write());
        // cells cannot be told from decimals, and a row of units is no number beneath headings in a comment
        let is_ambiguous = dialect.separator == dialect.decimal;
        let is_headless = matches!(dialect.comment, Comment::Headings) && dialect.headings.1.is_some();
        match found {
            Ok(sheet) => {
                assert!(!is_ambiguous, "{dialect:?}");
                let [column] = &*sheet.columns else { panic!("{dialect:?}") };
                assert_eq!((&*column.name, &*column.unit), ("phi", "deg"), "{dialect:?}");
                let values = sheet.complete(column, |text| quantity::parse_as(&PHI, text)).unwrap();
                let expected = NUMBERS.map(|[_, phi]| phi.to_radians());
                let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-15 * b.abs();
                assert!(values.iter().zip(&expected).all(near), "{dialect:?}: {values:?}");
                assert!(sheet.times.iter().zip(&NUMBERS.map(|[t, _]| 1e-3 * t)).all(near), "{dialect:?}");
                read += 1;
            }
            Err(error) => {
                assert!(is_ambiguous || is_headless, "{dialect:?}: {error}");
                let error = error.to_string();
                assert!(
                    !is_ambiguous || is_headless || error.contains("decimal comma"),
                    "{dialect:?}: {error}"
                );
                refused += 1;
            }
        }
    }
    assert!(read > 2000 && refused > 400, "{read} {refused}");
}

const PHI: Quantity = Quantity {
    name: "phi",
    doc: "",
    unit: "rad",
    scale: 1.0,
    dimension: mbs_runtime::Dimension::of(0, 0, 0),
    default: 0.0,
};

#[test]
fn names_with_parentheses_are_names() {
    let heading = |text: &str| {
        let column = SheetColumn::new(text);
        (column.name, column.unit)
    };
    let named = |name: &str, unit: &str| (name.to_owned(), unit.to_owned());
    assert_eq!(heading("der(x)"), named("der(x)", ""));
    assert_eq!(heading("der(m)"), named("der(m)", ""));
    assert_eq!(heading("der(x) (m/s²)"), named("der(x)", "m/s^2"));
    assert_eq!(heading("lambda(rod) [N]"), named("lambda(rod)", "N"));
    assert_eq!(heading("torque [Nm]"), named("torque", "N*m"));
    assert_eq!(heading("x [furlong]"), named("x", "furlong"));
    assert_eq!(heading("tip_time"), named("tip_time", ""));
}

#[test]
fn the_time_is_told_by_its_name_or_unit() {
    let first = |text: &str| sheet_of(text.as_bytes()).unwrap().columns[0].name.clone();
    assert_eq!(first("x,t\n1,0"), "x");
    assert_eq!(first("duration [s],t\n1,0"), "duration");
    assert_eq!(first("x;clock [ms]\n1;0"), "x");
    assert_eq!(first("x;Sampling Time\n1;0"), "x");
    assert_eq!(first("T;Time\n20;0"), "T");
    assert_eq!(first("x;T [ms]\n1;0"), "x");
    assert!(
        message("x,y\n1,0")
            .contains("none of its columns is the time: `x`, `y`; call the one that it is `t`")
    );
    assert!(message("t,time,x\n0,0,1").contains("`t`, `time` may each be the time"));
}

#[test]
fn what_is_no_table_is_refused_with_its_place() {
    for (text, part) in [
        ("t,x\n0,1\n1,2,3\n", "line 3 has 3 cells, and the headings in line 1 have 2"),
        ("t;x\n0,5;1.5\n", "line 2: t = `0,5`: it has a decimal comma, and `1.5` in line 2"),
        ("Rig 7\nt,x\n0,1\n", "line 2 has 2 cells, and the headings in line 1 have 1; cells are"),
        ("t x\n0 1\n", "separated by commas, semicolons or tabs"),
        ("", "it is empty"),
        ("t,x\n", "a heading for each column, and a row"),
        (
            "t,x [m]\n0,1\n1,1e155\n",
            "line 3: x = `1e155 m`: it is out of all measure, beyond 1e100 in SI units",
        ),
        ("t,x [m]\n0,1\n1,inf\n", "line 3: x = `inf m`: it has to be finite"),
        ("t,x [m]\n0,1\n1,broken\n", "line 3: x = `broken m`: that is not a number"),
        ("t,x [m],x [mm]\n0,1,1\n", "has two columns of that name"),
        ("t;x\ns;furlong\n0;1\n", "line 3: x = `1 furlong`: unknown unit"),
        ("t,x\nnoon,1\n", "line 2: time = `noon`"),
    ] {
        let found = message(text);
        assert!(found.contains(part), "{text:?}: {found}");
    }
    let binary = sheet_of(b"t,x\n\0\0\0").err().unwrap().to_string();
    assert!(binary.contains("save it as UTF-8"), "{binary}");
}

/// Instruments end each line with a separator, spreadsheets say which it is and quote headings.
#[test]
fn ends_and_quotes() {
    let values = |text: &str| {
        let sheet = sheet_of(text.as_bytes()).unwrap();
        let length = mbs_runtime::Dimension::of(0, 1, 0);
        sheet.values(&sheet.columns[0], |text| quantity::parse("x", text, length)).unwrap()
    };
    assert_eq!(values("t;x;\n0;1;\n1;;\n"), [Some(1.0), None]);
    assert_eq!(values("sep=;\nt;x\n0;1,5\n"), [Some(1.5)]);
    assert_eq!(values("\"time, from the start [s]\",\"x [m]\"\n0,1\n"), [Some(1.0)]);
    assert_eq!(values("t,x\n\n0,1\n,\n"), [Some(1.0)]);
    // a unit that is not known, of a column that nobody asks for
    assert_eq!(values("t;x;oil\ns;mm;°C\n0;1;20\n"), [Some(1e-3)]);
}
