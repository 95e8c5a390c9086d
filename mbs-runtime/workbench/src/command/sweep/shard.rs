//! A share of a sweep: some of its runs, in a file that goes on where it stopped.
//!
//! The first line of the file says which share of which sweep it is. While it is written it has the ending `.part`, and
//! every row that is whole counts. So a process may end at any time, and the next one with the same command goes on
//! behind the last row. A file that was damaged later loses no more than the rows behind the damage.

use std::fmt;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::axis::{Evenly, Grid, places};
use super::checked::{self, CheckedRows, Next};
use super::watched::Watched;
use crate::{Error, Model, Settings, table_file};

/// Which share of how many, from 1 on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    pub number: usize,
    pub of: usize,
}

/// The contents of the first line of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Heading {
    pub shard: Shard,
    /// The parameters of the sweep.
    pub swept: Vec<Swept>,
    /// Tells sweeps apart: a hash of the mechanism's equations, of the settings, the grid and what is looked at.
    fingerprint: u64,
}

/// A parameter of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Swept {
    pub name: String,
    values: Evenly,
    /// The unit in which its values are written, in SI units.
    unit: f64,
}

/// The lines above the rows of a share.
#[derive(Clone, Debug, PartialEq)]
pub struct Head {
    pub heading: Heading,
    /// The line with the names of the columns.
    pub columns: String,
}

/// State of the file of a share: missing, complete or damaged.
pub enum There {
    Nothing,
    Complete,
    /// The share, with what is wrong with it.
    Damaged(String),
}

/// The file of a share that is written.
pub struct Part {
    path: PathBuf,
    file: File,
    /// How many rows were there already.
    pub rows: usize,
}

impl Shard {
    /// Reads `3/16`.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let read = || {
            let (number, of) = text.split_once('/')?;
            Some(Self { number: number.trim().parse().ok()?, of: of.trim().parse().ok()? })
        };
        let found = read().filter(|shard| (1..=shard.of).contains(&shard.number));
        found.ok_or_else(|| Error::Value {
            what: "shard".into(),
            text: text.into(),
            reason: "write K/N, for instance 3/16 for the third of sixteen shares".into(),
        })
    }

    /// The runs that it has of so many: shares differ by one run at most.
    pub fn members(self, count: usize) -> Range<usize> {
        // in wide numbers, since the product may be large
        let from = |number: usize| (number as u128 * count as u128 / self.of as u128) as usize;
        from(self.number - 1)..from(self.number)
    }
}

impl Heading {
    /// Of a share of the sweep of a mechanism.
    pub(super) fn of(
        shard: Shard,
        model: &dyn Model,
        settings: &Settings,
        grid: &Grid,
        watched: &[Watched],
    ) -> Self {
        let mut hasher = DefaultHasher::new();
        // equations, names and units stand in their debug texts
        format!("{:?} {:?} {settings:?}", model.info(), model.derivation()).hash(&mut hasher);
        let swept = grid.axes.iter().map(|axis| Swept {
            name: axis.name.to_owned(),
            values: axis.values,
            unit: axis.unit.read(1.0),
        });
        let swept: Vec<_> = swept.collect();
        swept.iter().for_each(|swept| swept.to_string().hash(&mut hasher));
        watched.iter().for_each(|quantity| quantity.name.hash(&mut hasher));
        Self { shard, swept, fingerprint: hasher.finish() }
    }

    /// Number of runs of the whole sweep: the product of the numbers of values.
    pub fn count(&self) -> usize {
        self.swept.iter().map(|swept| swept.values.count).fold(1, usize::saturating_mul)
    }

    /// The values of a run in the units in which they are written.
    pub fn shown_values(&self, run: usize) -> impl Iterator<Item = f64> {
        let places = places(run, self.swept.iter().map(|swept| swept.values.count));
        self.swept.iter().zip(places).map(|(swept, at)| swept.values.at(at) / swept.unit)
    }

    /// The line.
    pub fn line(&self) -> String {
        let Self { shard: Shard { number, of }, swept, fingerprint } = self;
        let (count, swept): (_, Vec<_>) = (self.count(), swept.iter().map(Swept::to_string).collect());
        let swept = swept.join(", ");
        format!("# share {number}/{of} of a sweep of {count} runs, {fingerprint:016x}: {swept}")
    }

    /// Reads the line, if it is one.
    pub fn parse(line: &str) -> Option<Self> {
        let rest = line.trim_end().strip_prefix("# share ")?;
        let (shard, rest) = rest.split_once(" of a sweep of ")?;
        let (count, rest) = rest.split_once(" runs, ")?;
        let (fingerprint, swept) = rest.split_once(": ")?;
        let heading = Self {
            shard: Shard::parse(shard).ok()?,
            swept: swept.split(", ").map(Swept::parse).collect::<Option<_>>()?,
            fingerprint: u64::from_str_radix(fingerprint, 16).ok()?,
        };
        (count.parse() == Ok(heading.count())).then_some(heading)
    }

    /// Whether another file belongs to the same sweep, cut into as many shares.
    pub fn is_like(&self, other: &Self) -> bool {
        Self { shard: other.shard, ..self.clone() } == *other && self.shard.of == other.shard.of
    }
}

impl Swept {
    /// Reads `l1 0.05..0.08:31 in 0.001`.
    fn parse(text: &str) -> Option<Self> {
        let (name, rest) = text.split_once(' ')?;
        let (range, unit) = rest.split_once(" in ")?;
        let (low, rest) = range.split_once("..")?;
        let (high, count) = rest.split_once(':')?;
        let (low, high, count) = (low.parse().ok()?, high.parse().ok()?, count.parse().ok()?);
        Some(Self { name: name.to_owned(), values: Evenly { low, high, count }, unit: unit.parse().ok()? })
    }
}

impl fmt::Display for Swept {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, values: Evenly { low, high, count }, unit } = self;
        write!(f, "{name} {low:?}..{high:?}:{count} in {unit:?}")
    }
}

impl Head {
    /// Reads both lines, if they are those of a share.
    pub fn read(reader: &mut impl BufRead) -> io::Result<Option<Self>> {
        let mut line = || -> io::Result<Option<String>> {
            let mut line = Vec::new();
            checked::line(reader, &mut line)?;
            Ok(String::from_utf8(line).ok().filter(|line| line.ends_with('\n')))
        };
        let heading = line()?.as_deref().and_then(Heading::parse);
        let head = heading.zip(line()?).map(|(heading, columns)| Self { heading, columns });
        Ok(head)
    }

    /// Both lines.
    fn text(&self) -> String {
        format!("{}\n{}", self.heading.line(), self.columns)
    }

    /// The rows of a file that is read from its first row on.
    pub fn rows<R: BufRead>(&self, reader: R) -> CheckedRows<'_, R> {
        let mut columns = csv::ReaderBuilder::new().has_headers(false).from_reader(self.columns.as_bytes());
        let count = columns.records().next().and_then(Result::ok).map_or(0, |columns| columns.len());
        CheckedRows::new(reader, &self.heading, count)
    }

    /// State of the file of this share. A file of another share or sweep is refused, because it would be lost.
    pub fn there(&self, path: &Path) -> Result<There, Error> {
        if !path.try_exists().map_err(Error::file("read", path))? {
            return Ok(There::Nothing);
        }
        let whole = self.whole(table_file::lines(path)?).map_err(Error::file("read", path))?;
        match whole {
            Some(Whole { wrong: None, .. }) => Ok(There::Complete),
            Some(Whole { wrong: Some(wrong), .. }) => Ok(There::Damaged(wrong)),
            None => Err(Error::Name {
                name: path.display().to_string(),
                reason:
                    "there is a file of this name that is not this share of this sweep; remove it, or choose \
                     another name"
                        .into(),
            }),
        }
    }

    /// The sound part of a file of this share. `None` if the file has another head.
    fn whole(&self, mut reader: impl BufRead) -> io::Result<Option<Whole>> {
        if Self::read(&mut reader)?.as_ref() != Some(self) {
            return Ok(None);
        }
        let mut rows = self.rows(reader);
        let mut whole = Whole { rows: 0, bytes: self.text().len() as u64, wrong: None };
        loop {
            match rows.next()? {
                Next::Row(row) => {
                    (whole.rows, whole.bytes) = (whole.rows + 1, whole.bytes + row.len() as u64)
                }
                Next::End => return Ok(Some(whole)),
                Next::Wrong(wrong) => return Ok(Some(Whole { wrong: Some(wrong), ..whole })),
            }
        }
    }
}

/// The sound part of a file of a share.
#[derive(Default)]
struct Whole {
    /// How many rows come before the first wrong one.
    rows: usize,
    /// The length of the sound part in bytes, with the lines above the rows.
    bytes: u64,
    /// The reason why the next row is wrong, if there is one.
    wrong: Option<String>,
}

impl Part {
    /// Begins the file of a share, or goes on with it. The sound rows of a damaged share are taken over.
    pub fn open(path: &Path, head: &Head) -> Result<Self, Error> {
        table_file::check(path)?;
        let part = unfinished(path);
        let failed = || Error::file("write", &part);
        let options = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&part);
        let mut file = options.map_err(failed())?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => {
                let reason = "another process is writing it; wait for its end, or give it another name";
                return Err(Error::Name { name: part.display().to_string(), reason: reason.into() });
            }
            // some file systems have no locks
            Ok(()) | Err(TryLockError::Error(_)) => {}
        }
        let mut whole = head.whole(BufReader::new(&file)).map_err(failed())?.unwrap_or_default();
        if path.try_exists().map_err(Error::file("read", path))? {
            let damaged = head.whole(table_file::lines(path)?).map_err(Error::file("read", path))?;
            if let Some(damaged) = damaged.filter(|damaged| damaged.rows > whole.rows) {
                copy(table_file::lines(path)?, damaged.bytes, &mut file).map_err(failed())?;
                whole = damaged;
            }
        }
        let go_on = |file: &mut File| -> io::Result<()> {
            file.set_len(whole.bytes)?;
            file.seek(SeekFrom::End(0))?;
            if whole.bytes == 0 { file.write_all(head.text().as_bytes()) } else { Ok(()) }
        };
        go_on(&mut file).map_err(failed())?;
        Ok(Self { path: path.to_owned(), file, rows: whole.rows })
    }

    /// Gives the file its name.
    pub fn finish(self) -> Result<PathBuf, Error> {
        self.file.sync_all().map_err(Error::file("write", &self.path))?;
        fs::rename(unfinished(&self.path), &self.path).map_err(Error::file("write", &self.path))?;
        Ok(self.path)
    }

    /// Where the rows are that are there.
    pub fn kept(&self) -> PathBuf {
        unfinished(&self.path)
    }
}

impl Write for Part {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// The name of a file that is being written.
fn unfinished(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    path.with_file_name(name)
}

/// Makes the first bytes of a file the contents of another one.
fn copy(from: impl Read, bytes: u64, to: &mut File) -> io::Result<()> {
    to.rewind()?;
    to.set_len(0)?;
    io::copy(&mut from.take(bytes), to).map(drop)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    #[test]
    fn shares_are_all_runs_and_none_twice() {
        for (count, of) in [(7, 3), (3, 7), (100_000_000, 999), (16, 16), (1, 1)] {
            let shares: Vec<_> = (1..=of).map(|number| Shard { number, of }.members(count)).collect();
            assert_eq!((shares[0].start, shares[of - 1].end), (0, count));
            assert!(shares.windows(2).all(|pair| pair[0].end == pair[1].start));
            let lengths = shares.iter().map(Range::len);
            assert!(lengths.clone().max().unwrap() - lengths.min().unwrap() <= 1);
        }
        for text in ["0/4", "5/4", "4", "a/b", "1/0", ""] {
            assert!(Shard::parse(text).is_err(), "{text}");
        }
    }

    fn head(shard: &str) -> Head {
        Head { heading: heading(shard), columns: "l1 [mm],min a,max a,final a,error\n".into() }
    }

    /// A share of the sweep of l1 over 50, 60 and 70 mm.
    pub fn heading(shard: &str) -> Heading {
        let values = Evenly { low: 0.05, high: 0.07, count: 3 };
        let swept = vec![Swept { name: "l1".into(), values, unit: 1e-3 }];
        Heading { shard: Shard::parse(shard).unwrap(), swept, fingerprint: 0xabc }
    }

    const ROWS: [&str; 3] = ["50.0,1.0,2.0,1.5,\n", "60.0,1.0,2.0,1.5,\n", "70.0,1.0,2.0,1.5,\n"];

    #[test]
    fn a_file_goes_on_behind_its_last_whole_row() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("part.csv");
        let head = head("1/1");
        let mut part = Part::open(&path, &head).unwrap();
        part.write_all(ROWS[..2].concat().as_bytes()).unwrap();
        part.write_all(b"70.0,1.0").unwrap();
        assert!(Part::open(&path, &head).is_err_and(|error| error.to_string().contains("another process")));
        drop(part);
        let mut part = Part::open(&path, &head).unwrap();
        assert_eq!(part.rows, 2);
        part.write_all(ROWS[2].as_bytes()).unwrap();
        part.finish().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), head.text() + &ROWS.concat());
        assert!(matches!(head.there(&path), Ok(There::Complete)));
        // that of another sweep begins anew
        let other = Head { columns: "l1 [mm],min b,max b,final b,error\n".into(), ..head.clone() };
        fs::write(unfinished(&path), other.text() + ROWS[0]).unwrap();
        fs::remove_file(&path).unwrap();
        assert_eq!(Part::open(&path, &head).unwrap().rows, 0);
        assert_eq!(fs::read_to_string(unfinished(&path)).unwrap(), head.text());
    }

    /// Regression: a share that was cut inside its last row counted as complete.
    #[test]
    fn a_damaged_share_goes_on_behind_its_last_good_row() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("part.csv");
        let head = head("1/1");
        let text = head.text() + &ROWS.concat();
        let row = text.len() - ROWS[2].len();
        for cut in row..text.len() {
            fs::write(&path, &text[..cut]).unwrap();
            assert!(matches!(head.there(&path), Ok(There::Damaged(_))), "{cut}");
            let part = Part::open(&path, &head).unwrap();
            assert_eq!((part.rows, fs::read_to_string(part.kept()).unwrap().as_str()), (2, &text[..row]));
        }
        fs::write(&path, text.replace("60.0", "61.0")).unwrap();
        fs::remove_file(unfinished(&path)).unwrap();
        assert!(matches!(head.there(&path), Ok(There::Damaged(reason)) if reason.contains("row 2: `l1`")));
        assert_eq!(Part::open(&path, &head).unwrap().rows, 1);
    }

    #[test]
    fn the_first_line_reads_back() {
        let heading = heading("3/16");
        let line = "# share 3/16 of a sweep of 3 runs, 0000000000000abc: l1 0.05..0.07:3 in 0.001";
        assert_eq!(heading.line(), line);
        assert_eq!(Heading::parse(&format!("{line}\n")), Some(heading));
        for no in
            ["l1 [mm],omega [rpm]\n", &line.replace("of 3 runs", "of 4 runs"), &line.replace(" in ", " ")]
        {
            assert_eq!(Heading::parse(no), None, "{no}");
        }
    }
}
