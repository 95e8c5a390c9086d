//! Arrays for NumPy: a `.npz` file, which is a ZIP archive of `.npy` files (NumPy Enhancement Proposal 1).
//!
//! The container is that of the crate rawzip.

use std::io::{self, Write};

use rawzip::ZipArchiveWriter;

/// An array of a file.
pub(crate) enum Array {
    /// A matrix, row after row.
    Matrix { rows: usize, columns: usize, values: Vec<f64> },
    /// A vector.
    Vector(Vec<f64>),
    /// Texts.
    Texts(Vec<String>),
}

impl Array {
    /// The bytes of a `.npy` file: magic number, version, a dictionary in Python's notation that is filled up
    /// to 64 bytes, and little-endian numbers or characters of four bytes.
    fn npy(&self) -> Vec<u8> {
        let width =
            |texts: &[String]| texts.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(1);
        let (kind, shape) = match self {
            Self::Matrix { rows, columns, .. } => ("<f8".into(), format!("({rows}, {columns})")),
            Self::Vector(values) => ("<f8".into(), format!("({},)", values.len())),
            Self::Texts(texts) => (format!("<U{}", width(texts)), format!("({},)", texts.len())),
        };
        let mut header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
        const BEFORE: usize = 10;
        while !(BEFORE + header.len() + 1).is_multiple_of(64) {
            header.push(' ');
        }
        header.push('\n');
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend(u16::try_from(header.len()).unwrap_or(u16::MAX).to_le_bytes());
        bytes.extend(header.bytes());
        match self {
            Self::Matrix { values, .. } | Self::Vector(values) => {
                bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
            }
            Self::Texts(texts) => {
                let filled = |text: &String| {
                    let letters = text.chars().map(u32::from).chain(std::iter::repeat(0));
                    letters.take(width(texts)).collect::<Vec<_>>()
                };
                bytes.extend(texts.iter().flat_map(filled).flat_map(u32::to_le_bytes));
            }
        }
        bytes
    }
}

/// The bytes of a `.npz` file with these arrays, not compressed, as `numpy.savez` writes it.
///
/// # Errors
/// Those of writing to memory, which has room.
pub(crate) fn npz(arrays: &[(&str, Array)]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut archive = ZipArchiveWriter::new(&mut bytes);
    for (name, array) in arrays {
        let (mut file, config) = archive.new_file(format!("{name}.npy")).start().map_err(io::Error::other)?;
        let mut writer = config.wrap(&mut file);
        writer.write_all(&array.npy())?;
        let (_, description) = writer.finish().map_err(io::Error::other)?;
        file.finish(description).map_err(io::Error::other)?;
    }
    archive.finish().map_err(io::Error::other)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Header and data of a file of the archive.
    fn read(bytes: &[u8], name: &str) -> (String, Vec<u8>) {
        let archive = rawzip::ZipArchive::from_slice(bytes).unwrap();
        for entry in archive.entries() {
            let entry = entry.unwrap();
            if entry.file_path().as_ref() != name.as_bytes() {
                continue;
            }
            assert_eq!(entry.compression_method(), rawzip::CompressionMethod::STORE);
            let data = archive.get_entry(entry.wayfinder()).unwrap().data().to_vec();
            assert_eq!(&data[..8], b"\x93NUMPY\x01\x00");
            let length = usize::from(u16::from_le_bytes([data[8], data[9]]));
            assert!((10 + length).is_multiple_of(64), "data begin at a multiple of 64");
            return (
                String::from_utf8(data[10..10 + length].to_vec()).unwrap(),
                data[10 + length..].to_vec(),
            );
        }
        panic!("there is no {name}");
    }

    #[test]
    fn arrays_are_read_back() {
        let matrix =
            Array::Matrix { rows: 2, columns: 3, values: vec![1.0, -2.0, 3.5, 0.0, 1e-300, f64::NAN] };
        let texts = Array::Texts(vec!["der(θ)".into(), "x".into()]);
        let bytes = npz(&[("A", matrix), ("t", Array::Vector(vec![0.1])), ("states", texts)]).unwrap();
        let (header, data) = read(&bytes, "A.npy");
        assert_eq!(header.trim_end(), "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }");
        let numbers: Vec<f64> =
            data.chunks_exact(8).map(|chunk| f64::from_le_bytes(chunk.try_into().unwrap())).collect();
        assert_eq!(numbers[..5], [1.0, -2.0, 3.5, 0.0, 1e-300]);
        assert!(numbers[5].is_nan() && numbers.len() == 6);
        assert!(read(&bytes, "t.npy").0.contains("(1,)"));
        let (header, data) = read(&bytes, "states.npy");
        assert!(header.contains("'<U6'") && header.contains("(2,)") && header.ends_with('\n'), "{header}");
        let letters: Vec<char> = data
            .chunks_exact(4)
            .map(|chunk| char::from_u32(u32::from_le_bytes(chunk.try_into().unwrap())).unwrap())
            .collect();
        assert_eq!(letters.iter().collect::<String>(), "der(θ)x\0\0\0\0\0");
    }
}
