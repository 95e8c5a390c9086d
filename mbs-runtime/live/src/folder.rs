//! Files of tables, in the folder of a text.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use crate::text::LONGEST;

/// The text of a file in a folder, or why there is none.
pub fn read(folder: Option<&Path>, name: &str) -> Result<String, String> {
    let Some(folder) = folder else { return Err("this text has no folder".into()) };
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let found =
        fs::canonicalize(folder).and_then(|folder| Ok((fs::canonicalize(folder.join(name))?, folder)));
    let (path, folder) = found.map_err(|error| error.to_string())?;
    if !path.starts_with(folder) {
        return Err("it is not in that folder".into());
    }
    if !path.is_file() {
        return Err("it is no file".into());
    }
    let mut text = String::new();
    let read = File::open(&path).and_then(|file| file.take(LONGEST as u64 + 1).read_to_string(&mut text));
    match read {
        Err(error) => Err(error.to_string()),
        Ok(_) if text.len() > LONGEST => Err(format!("it has more than {LONGEST} bytes")),
        Ok(_) => Ok(text),
    }
}
