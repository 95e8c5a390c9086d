//! How a call ended.

use std::ffi::CStr;

use mbs_runtime::Error;

/// `mbs_status` of the header, which says what they mean, and where the numbers are fixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    Ok = 0,
    Null = 1,
    Utf8 = 2,
    Count = 3,
    Index = 4,
    Name = 5,
    File = 6,
    Declaration = 7,
    Value = 8,
    Method = 9,
    NotStarted = 10,
    Start = 11,
    Singular = 12,
    OutOfReach = 13,
    Diverged = 14,
    Undefined = 15,
    Accuracy = 16,
    Internal = 17,
}

/// The words of each status, by its number.
const WORDS: [&CStr; 18] = [
    c"no error",
    c"a pointer is NULL",
    c"a text is no UTF-8",
    c"an array has a wrong count",
    c"no such index",
    c"no such name",
    c"a file cannot be read",
    c"a text cannot be compiled",
    c"a number cannot be taken",
    c"the method does not fit",
    c"the run is not started",
    c"the start is not consistent",
    c"singular position",
    c"out of reach",
    c"the motion is not finite",
    c"a result is not finite",
    c"a step cannot be as accurate as asked",
    c"a mistake of the library",
];

/// A status in words.
pub fn words(status: i32) -> &'static CStr {
    usize::try_from(status).ok().and_then(|status| WORDS.get(status).copied()).unwrap_or(c"unknown status")
}

/// Why a call failed.
#[derive(Debug)]
pub struct Failure {
    /// The status that C is given.
    pub status: Status,
    /// The message that `mbs_error` gives.
    pub message: String,
    /// The problems of a text that was not compiled.
    pub problems: Vec<mbs_live::Problem>,
}

impl Failure {
    /// One with a message.
    pub fn new(status: Status, message: impl Into<String>) -> Self {
        Self { status, message: message.into(), problems: Vec::new() }
    }

    /// Something is NULL that must not be.
    pub fn null(what: &str) -> Self {
        Self::new(Status::Null, format!("`{what}` is NULL"))
    }
}

/// A text that was not compiled.
impl From<mbs_live::Error> for Failure {
    fn from(error: mbs_live::Error) -> Self {
        let message = error.to_string().trim_end().to_owned();
        Self { problems: error.problems().to_vec(), ..Self::new(Status::Declaration, message) }
    }
}

/// An error of a mechanism or a run.
impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let status = match error {
            Error::Parameter { .. }
            | Error::Input { .. }
            | Error::Step { .. }
            | Error::EndTime { .. }
            | Error::Time { .. }
            | Error::Gain { .. }
            | Error::Tolerance { .. }
            | Error::Memory { .. } => Status::Value,
            Error::NoEstimate { .. }
            | Error::VelocityForce { .. }
            | Error::ReducedStates { .. }
            | Error::Rates { .. }
            | Error::NoUseOfGain { .. }
            | Error::Scheme { .. }
            | Error::UnstableGains { .. }
            | Error::NoTranspose { .. }
            | Error::NotDriven { .. }
            | Error::OwnState { .. } => Status::Method,
            Error::NoCoordinate { .. } | Error::NoVariable { .. } => Status::Name,
            Error::Length { .. } => Status::Count,
            Error::Inconsistent { .. } | Error::NotAssembled { .. } => Status::Start,
            Error::Singular { .. } => Status::Singular,
            Error::OutOfReach { .. } => Status::OutOfReach,
            Error::NonFinite { .. } => Status::Diverged,
            Error::Undefined { .. } => Status::Undefined,
            Error::StepTooShort { .. }
            | Error::TooManySteps { .. }
            | Error::NotConverged { .. }
            | Error::EndlessEvents { .. }
            | Error::Sliding { .. }
            | Error::Undecided { .. } => Status::Accuracy,
            // a new kind of error has to be given a status here
            _ => Status::Internal,
        };
        Self::new(status, error.to_string())
    }
}
