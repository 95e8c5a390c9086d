//! Work without the interpreter's lock, which tells how far it is and can be interrupted.
//!
//! Every computation runs like this, in a thread of its own.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

use crate::error::raised;

/// How often Python is asked for an interruption and told how far the work is.
const INTERVAL: Duration = Duration::from_millis(50);

/// How far some work is, and whether it is still wanted.
#[derive(Default)]
pub struct Watch {
    done: AtomicUsize,
    all: AtomicUsize,
    pub cancel: AtomicBool,
}

impl Watch {
    /// So much is done.
    pub fn reached(&self, done: usize, all: usize) {
        self.done.fetch_max(done, Ordering::Relaxed);
        self.all.store(all, Ordering::Relaxed);
    }

    /// Whether the work is still wanted.
    pub fn goes_on(&self) -> bool {
        !self.cancel.load(Ordering::Relaxed)
    }

    fn tell(&self, py: Python<'_>, progress: Option<&Py<PyAny>>) -> PyResult<()> {
        py.check_signals()?;
        let (done, all) = (self.done.load(Ordering::Relaxed), self.all.load(Ordering::Relaxed));
        match progress {
            Some(progress) if all > 0 => progress.call1(py, (done, all)).map(drop),
            _ => Ok(()),
        }
    }
}

/// Does some work in a thread of its own. Meanwhile `progress` is called with how much is done, and how much there
/// is, and an interruption, or an exception of `progress`, cancels the work and is raised when it has ended.
pub fn watched<R: Send>(
    py: Python<'_>,
    progress: Option<&Py<PyAny>>,
    work: impl FnOnce(&Watch) -> R + Send,
) -> PyResult<R> {
    let watch = Watch::default();
    let outcome = py.detach(|| {
        thread::scope(|scope| {
            let (send, receive) = mpsc::channel();
            let of_work = &watch;
            scope.spawn(move || {
                // somebody waits until the thread has ended
                let _ = send.send(work(of_work));
            });
            let mut stopped = None;
            loop {
                match receive.recv_timeout(INTERVAL) {
                    Ok(result) => return (Some(result), stopped),
                    Err(RecvTimeoutError::Disconnected) => return (None, stopped),
                    Err(RecvTimeoutError::Timeout) if stopped.is_none() => {
                        stopped = Python::attach(|py| watch.tell(py, progress)).err();
                        watch.cancel.store(stopped.is_some(), Ordering::Relaxed);
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                }
            }
        })
    });
    match outcome {
        (_, Some(stopped)) => Err(stopped),
        (Some(result), None) => {
            watch.tell(py, progress)?;
            Ok(result)
        }
        (None, None) => Err(raised(py, "a computation came to an unforeseen end; please report this")),
    }
}
