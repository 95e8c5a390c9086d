//! What stands in place of Parquet in a program that is built without it.

use std::fs::File;
use std::path::Path;

use super::not_built;
use crate::Error;

/// # Errors
/// Always.
pub(super) fn write(_rows: &Path, path: &Path) -> Result<(), Error> {
    Err(not_built(path))
}

/// # Errors
/// Always.
pub(super) fn as_csv(_file: File, path: &Path) -> Result<File, Error> {
    Err(not_built(path))
}
