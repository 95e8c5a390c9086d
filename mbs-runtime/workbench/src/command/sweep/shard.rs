//! A share of a sweep: some of its runs, in a file that goes on where it stopped.
//!
//! The first line of the file says which share of which sweep it is. While it is written it has the ending `.part`, and
//! every row that is whole counts. So a process may end at any time, and the next one with the same command goes on
//! behind the last row.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, BufRead, BufReader, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::Watched;
use super::axis::Grid;
use crate::{Error, Model, Settings, table_file};

/// Which share of how many, from 1 on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    pub number: usize,
    pub of: usize,
}

/// What the first line of a file says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Heading {
    pub shard: Shard,
    /// How many runs the whole sweep has.
    pub count: usize,
    /// Tells sweeps apart: a hash of the mechanism's equations, of the settings, the grid and what is looked at.
    fingerprint: u64,
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
        for axis in &grid.axes {
            axis.name.hash(&mut hasher);
            axis.bits().for_each(|bits| bits.hash(&mut hasher));
        }
        watched.iter().for_each(|quantity| quantity.name.hash(&mut hasher));
        Self { shard, count: grid.count(), fingerprint: hasher.finish() }
    }

    /// The line.
    pub fn line(&self) -> String {
        let Self { shard: Shard { number, of }, count, fingerprint } = self;
        format!("# share {number}/{of} of a sweep of {count} runs, {fingerprint:016x}")
    }

    /// Reads the line, if it is one.
    pub fn parse(line: &str) -> Option<Self> {
        let rest = line.trim_end().strip_prefix("# share ")?;
        let (shard, rest) = rest.split_once(" of a sweep of ")?;
        let (count, fingerprint) = rest.split_once(" runs, ")?;
        Some(Self {
            shard: Shard::parse(shard).ok()?,
            count: count.parse().ok()?,
            fingerprint: u64::from_str_radix(fingerprint, 16).ok()?,
        })
    }

    /// Whether another file belongs to the same sweep, cut into as many shares.
    pub fn is_like(&self, other: &Self) -> bool {
        self.shard.of == other.shard.of && self.count == other.count && self.fingerprint == other.fingerprint
    }

    /// Whether a file is this share, complete. One of another sweep is refused, because it would be lost.
    pub fn is_complete(&self, path: &Path) -> Result<bool, Error> {
        if !path.try_exists().map_err(Error::file("read", path))? {
            return Ok(false);
        }
        let mut line = String::new();
        table_file::lines(path)?.read_line(&mut line).map_err(Error::file("read", path))?;
        if Self::parse(&line).as_ref() == Some(self) {
            return Ok(true);
        }
        Err(Error::Name {
            name: path.display().to_string(),
            reason:
                "there is a file of this name that is not this share of this sweep; remove it, or choose \
                     another name"
                    .into(),
        })
    }
}

impl Part {
    /// Begins the file of a share, or goes on with it: `head` is its first lines.
    pub fn open(path: &Path, head: &str) -> Result<Self, Error> {
        table_file::is_parquet(path)?;
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
        let (rows, bytes) = whole(&file, head).map_err(failed())?;
        let go_on = |file: &mut File| -> io::Result<()> {
            file.set_len(bytes)?;
            file.seek(SeekFrom::End(0))?;
            if bytes == 0 { file.write_all(head.as_bytes()) } else { Ok(()) }
        };
        go_on(&mut file).map_err(failed())?;
        Ok(Self { path: path.to_owned(), file, rows })
    }

    /// Gives the file its form and its name.
    pub fn finish(self) -> Result<PathBuf, Error> {
        self.file.sync_all().map_err(Error::file("write", &self.path))?;
        let rows = unfinished(&self.path);
        if table_file::is_parquet(&self.path)? {
            table_file::to_parquet(&rows, &self.path)?;
        } else {
            fs::rename(rows, &self.path).map_err(Error::file("write", &self.path))?;
        }
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

/// How many rows of a file are whole, and how many bytes that is with its head; none if it begins otherwise.
fn whole(file: &File, head: &str) -> io::Result<(usize, u64)> {
    let mut reader = BufReader::new(file);
    reader.rewind()?;
    let (mut line, mut bytes, mut rows) = (Vec::new(), 0, 0);
    for expected in head.split_inclusive('\n') {
        line.clear();
        bytes += reader.read_until(b'\n', &mut line)? as u64;
        if line != expected.as_bytes() {
            return Ok((0, 0));
        }
    }
    loop {
        line.clear();
        let length = reader.read_until(b'\n', &mut line)? as u64;
        if line.last() != Some(&b'\n') {
            return Ok((rows, bytes));
        }
        (rows, bytes) = (rows + 1, bytes + length);
    }
}

#[cfg(test)]
mod tests {
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

    #[test]
    fn a_file_goes_on_behind_its_last_whole_row() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("part.csv");
        let head = "# share 1/2\na,b\n";
        let mut part = Part::open(&path, head).unwrap();
        part.write_all(b"1,2\n3,4\n5,").unwrap();
        assert!(Part::open(&path, head).is_err_and(|error| error.to_string().contains("another process")));
        drop(part);
        let mut part = Part::open(&path, head).unwrap();
        assert_eq!(part.rows, 2);
        part.write_all(b"5,6\n").unwrap();
        part.finish().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), format!("{head}1,2\n3,4\n5,6\n"));
        // that of another sweep begins anew
        fs::write(unfinished(&path), "# share 1/3\na,b\n1,2\n").unwrap();
        assert_eq!(Part::open(&path, head).unwrap().rows, 0);
        assert_eq!(fs::read_to_string(unfinished(&path)).unwrap(), head);
    }

    #[test]
    fn the_first_line_reads_back() {
        let heading = Heading { shard: Shard { number: 3, of: 16 }, count: 1271, fingerprint: 0xabc };
        assert_eq!(heading.line(), "# share 3/16 of a sweep of 1271 runs, 0000000000000abc");
        assert_eq!(Heading::parse(&format!("{}\n", heading.line())), Some(heading));
        assert_eq!(Heading::parse("l1 [mm],omega [rpm]\n"), None);
    }
}
