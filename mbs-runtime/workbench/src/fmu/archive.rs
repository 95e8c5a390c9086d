//! ZIP archives, compressed.

use std::io::{self, Write};

use flate2::Compression;
use flate2::write::DeflateEncoder;
use rawzip::time::UtcDateTime;
use rawzip::{CompressionMethod, ZipArchiveWriter};

/// The bytes of an archive with these files, by their paths. Archives of equal files are equal.
pub(crate) fn zip(files: &[(String, Vec<u8>)]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut archive = ZipArchiveWriter::new(&mut bytes);
    for (name, content) in files {
        let mut file = archive.new_file(name).compression_method(CompressionMethod::DEFLATE);
        // the first day that archives know: some programs refuse a file without a date
        if let Some(date) = UtcDateTime::from_components(1980, 1, 1, 0, 0, 0, 0) {
            file = file.last_modified(date);
        }
        let (mut entry, config) = file.start().map_err(io::Error::other)?;
        let mut writer = config.wrap(DeflateEncoder::new(&mut entry, Compression::default()));
        writer.write_all(content)?;
        let (encoder, description) = writer.finish().map_err(io::Error::other)?;
        encoder.finish()?;
        entry.finish(description).map_err(io::Error::other)?;
    }
    archive.finish().map_err(io::Error::other)?;
    Ok(bytes)
}
