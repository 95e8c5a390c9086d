//! Files that have their name once they are complete.
//!
//! A plain file is written beside its place under a name that nobody else has, and then
//! moved there: what is read under the final name is whole, and comes from one run. What
//! is no plain file, such as a pipe, a device or a link, is written through and stays what
//! it is.

use std::fs::{File, OpenOptions, Permissions};
use std::io::{self, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use tempfile::NamedTempFile;

use crate::Error;

/// Files that are read are no longer than so many bytes, so that an endless one comes to an end.
pub(crate) const LARGEST_FILE: u64 = 64 << 20;

/// The files that this program has read. None of them is written: an output that has the name of a declaration would
/// be the end of it.
static READ: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Notes that a file is read.
pub(crate) fn note_read(path: &Path) {
    if let (Ok(place), Ok(mut read)) = (path.canonicalize(), READ.lock()) {
        read.push(place);
    }
}

/// Refuses to write a plain file that was read.
fn check_unread(path: &Path) -> Result<(), Error> {
    let place = path.canonicalize().ok().filter(|place| place.is_file());
    match (place, READ.lock()) {
        (Some(place), Ok(read)) if read.contains(&place) => Err(Error::Name {
            name: path.display().to_string(),
            reason: "it is read here; give what is written another name".into(),
        }),
        _ => Ok(()),
    }
}

/// The bytes of a file.
///
/// # Errors
/// [`Error::File`], also of one that is longer than [`LARGEST_FILE`].
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Error> {
    note_read(path);
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes));
    let read = read.and_then(|_| {
        let too_large = || format!("it is longer than {} MiB", LARGEST_FILE >> 20);
        let is_short = bytes.len() as u64 <= LARGEST_FILE;
        if is_short { Ok(()) } else { Err(io::Error::new(ErrorKind::FileTooLarge, too_large())) }
    });
    read.map(|()| bytes).map_err(Error::file("read", path))
}

/// A file that is being written. Dropped before [`finish`](Self::finish), it leaves
/// nothing behind.
pub(crate) struct Output {
    /// As it was asked for.
    path: PathBuf,
    target: Target,
}

enum Target {
    /// A file beside the one that it becomes.
    Part(NamedTempFile, PathBuf),
    Through(File),
    Standard(io::Stdout),
}

impl Output {
    /// Begins to write what is to be called `path`.
    pub fn create(path: &Path) -> Result<Self, Error> {
        check_unread(path)?;
        let target = target(path).map_err(Error::file("write", path))?;
        Ok(Self { path: path.to_owned(), target })
    }

    /// Gives the file its name.
    pub fn finish(mut self) -> Result<PathBuf, Error> {
        let flushed = self.flush();
        let Self { path, target } = self;
        let moved = flushed.and_then(|()| match target {
            Target::Part(part, place) => part.persist(place).map(drop).map_err(|error| error.error),
            Target::Through(_) | Target::Standard(_) => Ok(()),
        });
        moved.map_err(Error::file("write", &path))?;
        Ok(path)
    }

    /// Leaves the unfinished file where it is, and says where that is.
    pub fn keep(mut self) -> Result<PathBuf, Error> {
        let flushed = self.flush();
        let Self { path, target } = self;
        let kept = flushed.and_then(|()| match target {
            // Under the name of the folder that was asked for, which may be relative.
            Target::Part(part, place) => match part.keep() {
                Ok((_, kept)) => Ok(place.with_file_name(kept.file_name().unwrap_or_default())),
                Err(error) => Err(error.error),
            },
            Target::Through(_) | Target::Standard(_) => Ok(path.clone()),
        });
        kept.map_err(Error::file("write", &path))
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.target {
            Target::Part(part, _) => part.write(bytes),
            Target::Through(file) => file.write(bytes),
            Target::Standard(stdout) => stdout.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.target {
            Target::Part(part, _) => part.flush(),
            Target::Through(file) => file.flush(),
            Target::Standard(stdout) => stdout.flush(),
        }
    }
}

/// Refuses a file that cannot be written, before the work whose results it is for.
///
/// It leaves nothing behind, and neither opens a pipe or a device nor follows a link that points to nothing.
///
/// # Errors
/// [`Error::File`], and [`Error::Name`] of a file that this program has read.
pub fn check_writable(path: &Path) -> Result<(), Error> {
    check_unread(path)?;
    let checked = match std::fs::metadata(path) {
        Ok(there) if there.is_file() || there.is_dir() => {
            OpenOptions::new().append(true).open(path).map(drop)
        }
        Ok(_) => Ok(()),
        Err(_) if path.is_symlink() => Ok(()),
        Err(error) if error.kind() == ErrorKind::NotFound => part(path, None).map(drop),
        Err(error) => Err(error),
    };
    checked.map_err(Error::file("write", path))
}

/// Writes a file at once.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut output = Output::create(path)?;
    output.write_all(bytes).map_err(Error::file("write", path))?;
    output.finish().map(drop)
}

fn target(path: &Path) -> io::Result<Target> {
    if path == Path::new("/dev/stdout") {
        return Ok(Target::Standard(io::stdout()));
    }
    match std::fs::metadata(path) {
        Ok(there) if there.is_file() && !path.starts_with("/dev") && !path.starts_with("/proc") => {
            // Who may not write the file may not replace it either.
            let file = OpenOptions::new().write(true).open(path)?;
            // The file at the end of links, so that they go on pointing to it.
            match part(&path.canonicalize()?, Some(there.permissions())) {
                Err(error) if error.kind() == ErrorKind::PermissionDenied => {
                    file.set_len(0)?;
                    Ok(Target::Through(file))
                }
                part => part,
            }
        }
        Ok(_) => Ok(Target::Through(OpenOptions::new().append(true).open(path)?)),
        // A link that points to nothing yet makes what it points to.
        Err(_) if path.is_symlink() => Ok(Target::Through(File::create(path)?)),
        Err(error) if error.kind() == ErrorKind::NotFound => part(path, None),
        Err(error) => Err(error),
    }
}

/// A file beside `place` under a name of its own.
fn part(place: &Path, permissions: Option<Permissions>) -> io::Result<Target> {
    let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut prefix = place.file_name().unwrap_or_default().to_owned();
    prefix.push(".");
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".part");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    // The library names the file that it tried to make, which nobody asked for.
    let of_folder = |error: io::Error| match error.kind() {
        kind if !folder.exists() => io::Error::new(kind, format!("there is no folder {}", folder.display())),
        kind => io::Error::new(kind, format!("no file can be made in {}: {kind}", folder.display())),
    };
    let part = builder.tempfile_in(folder).map_err(of_folder)?;
    if let Some(permissions) = permissions {
        part.as_file().set_permissions(permissions)?;
    }
    Ok(Target::Part(part, place.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn two_writers_of_one_name_do_not_mix() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.csv");
        let (mut first, mut second) = (Output::create(&path).unwrap(), Output::create(&path).unwrap());
        for _ in 0..1000 {
            first.write_all(b"first\n").unwrap();
            second.write_all(b"second\n").unwrap();
        }
        assert!(!path.exists());
        first.finish().unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "first\n".repeat(1000));
        second.finish().unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "second\n".repeat(1000));
        assert_eq!(names(folder.path()), ["out.csv"]);
    }

    #[test]
    fn what_is_not_finished_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let mut output = Output::create(&folder.path().join("a.svg")).unwrap();
        output.write_all(b"half").unwrap();
        drop(output);
        assert!(names(folder.path()).is_empty());
        let mut output = Output::create(&folder.path().join("a.svg")).unwrap();
        output.write_all(b"half").unwrap();
        let kept = output.keep().unwrap();
        assert_eq!(std::fs::read_to_string(&kept).unwrap(), "half");
        let name = kept.file_name().unwrap().to_str().unwrap();
        assert!(name.starts_with("a.svg.") && name.ends_with(".part"), "{name}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn an_endless_file_ends() {
        let message = read(Path::new("/dev/zero")).unwrap_err().to_string();
        assert_eq!(message, "cannot read /dev/zero: it is longer than 64 MiB");
    }

    #[cfg(unix)]
    #[test]
    fn links_devices_and_modes_stay() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("real"), "old").unwrap();
        std::fs::set_permissions(at("real"), Permissions::from_mode(0o640)).unwrap();
        symlink(at("real"), at("link")).unwrap();
        write(&at("link"), b"new").unwrap();
        assert!(at("link").is_symlink());
        assert_eq!(std::fs::read_to_string(at("real")).unwrap(), "new");
        assert_eq!(std::fs::metadata(at("real")).unwrap().permissions().mode() & 0o777, 0o640);
        symlink(at("later"), at("ahead")).unwrap();
        write(&at("ahead"), b"new").unwrap();
        assert!(at("ahead").is_symlink() && at("later").is_file());
        write(Path::new("/dev/null"), b"nothing").unwrap();
        assert!(!std::fs::metadata("/dev/null").unwrap().is_file());
        let directory = write(folder.path(), b"").unwrap_err().to_string();
        assert!(directory.contains("cannot write"), "{directory}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_reported() {
        let refused = write(Path::new("/dev/full"), b"text").unwrap_err().to_string();
        assert!(refused.contains("cannot write /dev/full: No space left"), "{refused}");
    }
}
