//! CSV to Parquet, and back.
//!
//! Numbers stay what they are to the bit, and an empty cell is a null. The comment that a table
//! begins with is kept in the metadata of the file.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Seek, Write};
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::record::{Row, RowAccessor};
use parquet::schema::types::{Type, TypePtr};

use crate::Error;
use crate::csv_file::csv_number;
use crate::files::Output;

/// The column that has words; all others have numbers.
const WORDS: &str = "error";
/// The comment of a table among the metadata of its file.
const COMMENT: &str = "mbs";
/// As many rows are compressed together: some megabytes in memory.
const ROWS: usize = 1 << 16;

/// The cells of a column, without those that are empty.
enum Cells {
    Numbers(Vec<f64>),
    Words(Vec<ByteArray>),
}

struct Column {
    cells: Cells,
    /// 1 for a row that has a cell, 0 for one in which it is empty.
    levels: Vec<i16>,
}

impl Column {
    fn of(name: &str) -> Self {
        let cells = if name == WORDS { Cells::Words(Vec::new()) } else { Cells::Numbers(Vec::new()) };
        Self { cells, levels: Vec::new() }
    }

    fn push(&mut self, cell: &str) -> io::Result<()> {
        self.levels.push(i16::from(!cell.is_empty()));
        match &mut self.cells {
            _ if cell.is_empty() => {}
            Cells::Words(words) => words.push(cell.into()),
            Cells::Numbers(numbers) => numbers.push(cell.parse().map_err(io::Error::other)?),
        }
        Ok(())
    }

    /// Writes the cells, and forgets them.
    fn write<W: Write + Send>(
        &mut self,
        group: &mut SerializedRowGroupWriter<'_, W>,
    ) -> Result<(), ParquetError> {
        let Some(mut writer) = group.next_column()? else { return Ok(()) };
        let levels = Some(self.levels.as_slice());
        match &mut self.cells {
            Cells::Words(words) => {
                writer.typed::<ByteArrayType>().write_batch(words, levels, None)?;
                words.clear();
            }
            Cells::Numbers(numbers) => {
                writer.typed::<DoubleType>().write_batch(numbers, levels, None)?;
                numbers.clear();
            }
        }
        self.levels.clear();
        writer.close()
    }
}

/// Writes the rows of a CSV file as a Parquet file.
///
/// # Errors
/// [`Error::File`].
pub(super) fn write(rows: &Path, path: &Path) -> Result<(), Error> {
    let mut output = Output::create(path)?;
    let file = File::open(rows).map_err(Error::file("read", rows))?;
    converted(file, &mut output).map_err(Error::file("write", path))?;
    output.finish().map(drop)
}

fn converted(rows: File, output: &mut Output) -> io::Result<()> {
    let mut lines = BufReader::new(rows);
    let comment = comment(&mut lines)?;
    let mut table = csv::Reader::from_reader(lines);
    let names: Vec<String> = table.headers()?.iter().map(Into::into).collect();
    let comment = comment.map(|line| vec![KeyValue::new(COMMENT.to_owned(), line)]);
    let properties = WriterProperties::builder()
        .set_created_by(concat!("mbs ", env!("CARGO_PKG_VERSION")).to_owned())
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(comment)
        .build();
    let mut writer = SerializedFileWriter::new(output, schema(&names)?, Arc::new(properties))?;
    let mut columns: Vec<Column> = names.iter().map(|name| Column::of(name)).collect();
    let (mut record, mut count) = (csv::StringRecord::new(), 0);
    loop {
        let is_row = table.read_record(&mut record)?;
        if count == ROWS || (!is_row && count > 0) {
            let mut group = writer.next_row_group()?;
            columns.iter_mut().try_for_each(|column| column.write(&mut group))?;
            group.close()?;
            count = 0;
        }
        if !is_row {
            break;
        }
        columns.iter_mut().zip(&record).try_for_each(|(column, cell)| column.push(cell))?;
        count += 1;
    }
    writer.close()?;
    Ok(())
}

/// The first line of a table if it is a comment, which says what the table is.
fn comment(lines: &mut impl BufRead) -> io::Result<Option<String>> {
    if !lines.fill_buf()?.starts_with(b"#") {
        return Ok(None);
    }
    let mut line = String::new();
    lines.read_line(&mut line)?;
    Ok(Some(line))
}

fn schema(names: &[String]) -> Result<TypePtr, ParquetError> {
    let column = |name: &String| {
        let (physical, logical) = match name == WORDS {
            true => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
            false => (Physical::DOUBLE, None),
        };
        let column = Type::primitive_type_builder(name, physical).with_repetition(Repetition::OPTIONAL);
        column.with_logical_type(logical).build().map(Arc::new)
    };
    let columns = names.iter().map(column).collect::<Result<_, _>>()?;
    Type::group_type_builder("sweep").with_fields(columns).build().map(Arc::new)
}

/// The table of a Parquet file, as a CSV file without a name.
///
/// # Errors
/// [`Error::File`].
pub(super) fn as_csv(file: File, path: &Path) -> Result<File, Error> {
    let read = || -> io::Result<File> {
        let reader = SerializedFileReader::new(file)?;
        let metadata = reader.metadata().file_metadata();
        let mut output = tempfile::tempfile()?;
        let pairs = metadata.key_value_metadata().into_iter().flatten();
        let comment = pairs.filter(|pair| pair.key == COMMENT).find_map(|pair| pair.value.as_deref());
        output.write_all(comment.unwrap_or_default().as_bytes())?;
        let mut table = csv::Writer::from_writer(output);
        table.write_record(metadata.schema_descr().columns().iter().map(|column| column.name()))?;
        for row in reader.get_row_iter(None)? {
            let row = row?;
            let cells = (0..row.len()).map(|at| cell(&row, at)).collect::<Result<Vec<_>, _>>()?;
            table.write_record(cells)?;
        }
        let mut output = table.into_inner().map_err(csv::IntoInnerError::into_error)?;
        output.rewind()?;
        Ok(output)
    };
    read().map_err(Error::file("read", path))
}

fn cell(row: &Row, at: usize) -> Result<String, ParquetError> {
    if row.is_null(at)? {
        return Ok(String::new());
    }
    row.get_double(at).map(csv_number).or_else(|_| row.get_string(at).cloned())
}
