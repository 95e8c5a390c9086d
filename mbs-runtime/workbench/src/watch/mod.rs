//! A page that follows a file: every save shows what became of it.
//!
//! # How it works
//!
//! The file is followed by its contents. `server` answers this machine alone, by `http`. The page in the
//! browser is a shell that asks for news. It shows the report, or the page to play, in a frame without
//! rights of its own. After an error it shows that above the last good page.

mod http;
mod server;

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use std::{fs, io, thread};

use crate::Error;
use crate::files::{self, LARGEST_FILE};

pub(crate) use server::Server;

/// How often the file is looked at.
const GRAIN: Duration = Duration::from_millis(50);

/// The pages that show a mechanism.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pages {
    /// A run as it was recorded.
    pub recorded: String,
    /// The mechanism, to be played; nothing where other steps are asked for than a page makes.
    pub played: Option<String>,
}

/// The outcome of the file: pages, or its error.
pub(crate) type Outcome = Result<Pages, String>;

/// The state of a followed file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Shown {
    /// Counts the outcomes.
    pub version: u64,
    /// The last pages that there were, and their version.
    pub pages: Option<(u64, Pages)>,
    /// The error of the file as it is now.
    pub error: Option<String>,
}

/// The state of a followed file, for those who wait for news of it.
#[derive(Debug, Default)]
pub(crate) struct News {
    shown: Mutex<Shown>,
    changed: Condvar,
}

impl News {
    /// The next outcome. Pages outlive the errors after them.
    pub fn tell(&self, outcome: Outcome) {
        let mut shown = self.now();
        shown.version += 1;
        match outcome {
            Ok(pages) => (shown.pages, shown.error) = (Some((shown.version, pages)), None),
            Err(error) => shown.error = Some(error),
        }
        drop(shown);
        self.changed.notify_all();
    }

    /// The state of the file now.
    pub fn now(&self) -> MutexGuard<'_, Shown> {
        // whoever panicked left a whole value
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The same as soon as it is newer than `version`, or after this time.
    pub fn after(&self, version: u64, patience: Duration) -> MutexGuard<'_, Shown> {
        let is_old = |shown: &mut Shown| shown.version <= version;
        let waited = self.changed.wait_timeout_while(self.now(), patience, is_old);
        waited.unwrap_or_else(PoisonError::into_inner).0
    }
}

/// Tells what `make` makes of a file, now and whenever the file has changed, until `end`.
///
/// The file is compared by its contents: an editor may replace it by another one, or write
/// it without changing it. While it cannot be read, as between the two halves of a
/// replacement, nothing is told for a moment.
pub(crate) fn follow(path: &Path, make: &dyn Fn() -> Outcome, news: &News, end: &AtomicBool) {
    const PATIENCE: u32 = 20;
    let mut known: Option<Vec<u8>> = None;
    let mut missing = 0;
    while !end.load(Ordering::Relaxed) {
        match contents(path) {
            Ok(contents) => {
                if known.as_ref() != Some(&contents) {
                    known = Some(contents);
                    news.tell(make());
                }
                missing = 0;
            }
            Err(error) => {
                missing += 1;
                if missing == PATIENCE {
                    known = None;
                    news.tell(Err(error.to_string()));
                }
            }
        }
        thread::sleep(GRAIN);
    }
}

/// The bytes of a plain file. A device or a pipe might have no end, or none for now.
fn contents(path: &Path) -> Result<Vec<u8>, Error> {
    let there = fs::metadata(path).map_err(Error::file("read", path))?;
    if !there.is_file() || there.len() > LARGEST_FILE {
        let reason = format!("only a plain file of at most {} MiB is followed", LARGEST_FILE >> 20);
        return Err(Error::file("read", path)(io::Error::other(reason)));
    }
    files::read(path)
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use super::*;

    fn pages(recorded: &str) -> Pages {
        Pages { recorded: recorded.into(), played: None }
    }

    #[test]
    fn pages_outlive_the_errors_after_them() {
        let news = News::default();
        news.tell(Ok(pages("good")));
        news.tell(Err("bad".into()));
        let now = news.now().clone();
        assert_eq!(now, Shown { version: 2, pages: Some((1, pages("good"))), error: Some("bad".into()) });
        news.tell(Ok(pages("better")));
        assert_eq!(*news.now(), Shown { version: 3, pages: Some((3, pages("better"))), error: None });
    }

    /// Saves in place, by replacement and without change; the file goes away and comes back.
    #[test]
    fn every_save_is_told_within_a_second() {
        let folder = tempfile::tempdir().unwrap();
        let (path, other) = (folder.path().join("a.mbs"), folder.path().join("b.mbs"));
        fs::write(&path, "1").unwrap();
        let (news, end) = (News::default(), AtomicBool::new(false));
        let make = || fs::read_to_string(&path).map(|text| pages(&text)).map_err(|error| error.to_string());
        thread::scope(|scope| {
            scope.spawn(|| follow(&path, &make, &news, &end));
            let mut version = 0;
            let mut next = || {
                let start = Instant::now();
                let shown = news.after(version, Duration::from_secs(10)).clone();
                assert!(shown.version == version + 1 && start.elapsed() < Duration::from_secs(5));
                version = shown.version;
                shown.error.map_or_else(|| shown.pages.unwrap().1.recorded, |_| "missing".into())
            };
            assert_eq!(next(), "1");
            fs::write(&path, "2").unwrap();
            assert_eq!(next(), "2");
            fs::write(&other, "3").unwrap();
            fs::rename(&other, &path).unwrap();
            assert_eq!(next(), "3");
            fs::write(&path, "3").unwrap();
            fs::remove_file(&path).unwrap();
            assert_eq!(next(), "missing");
            fs::write(&path, "3").unwrap();
            assert_eq!(next(), "3");
            // Regression: a link to a device without an end was read for ever.
            #[cfg(unix)]
            {
                fs::remove_file(&path).unwrap();
                std::os::unix::fs::symlink("/dev/zero", &path).unwrap();
                assert_eq!(next(), "missing");
            }
            end.store(true, Ordering::Relaxed);
        });
    }
}
