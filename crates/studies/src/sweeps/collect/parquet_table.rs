//! `results.parquet`: texts as strings, doubles beside them; a group of rows at a time.

use std::io;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{ConvertedType, Repetition, Type as PhysicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use parquet::schema::types::Type;
use shadowstep_scenes::{Error, WholeFile};

use super::table::{Cell, Head, Table, TableColumn};

/// Rows that are kept in memory until they are written.
const GROUP: usize = 1 << 16;

pub(super) struct ParquetTable {
    writer: SerializedFileWriter<WholeFile>,
    columns: Vec<TableColumn>,
    rows: Vec<Vec<Cell>>,
}

impl ParquetTable {
    pub(super) fn new(path: &Path, head: &Head) -> Result<Self, Error> {
        let file = WholeFile::create(path, "file")?;
        let fields = head.columns.iter().map(field).collect::<Result<Vec<_>, _>>().map_err(failed)?;
        let schema = Type::group_type_builder("results").with_fields(fields).build().map_err(failed)?;
        let pairs = head.lines.iter().map(|(name, value)| KeyValue::new((*name).to_owned(), value.clone()));
        let properties = WriterProperties::builder().set_key_value_metadata(Some(pairs.collect())).build();
        let writer = SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties)).map_err(failed)?;
        Ok(ParquetTable { writer, columns: head.columns.clone(), rows: Vec::new() })
    }

    /// Writes the rows that are kept.
    fn write_group(&mut self) -> Result<(), Error> {
        if self.rows.is_empty() {
            return Ok(());
        }
        let mut group = self.writer.next_row_group().map_err(failed)?;
        let mut place = 0;
        while let Some(mut column) = group.next_column().map_err(failed)? {
            write_column(&mut column, &self.columns[place], self.rows.iter().map(|row| &row[place]))?;
            column.close().map_err(failed)?;
            place += 1;
        }
        group.close().map_err(failed)?;
        self.rows.clear();
        Ok(())
    }
}

/// A column whose values may be missing.
fn field(column: &TableColumn) -> Result<Arc<Type>, ParquetError> {
    let physical = if column.is_double { PhysicalType::DOUBLE } else { PhysicalType::BYTE_ARRAY };
    let converted = if column.is_double { ConvertedType::NONE } else { ConvertedType::UTF8 };
    let builder = Type::primitive_type_builder(&column.name, physical);
    Ok(Arc::new(builder.with_repetition(Repetition::OPTIONAL).with_converted_type(converted).build()?))
}

fn write_column<'a>(
    column: &mut SerializedColumnWriter<'_>,
    description: &TableColumn,
    cells: impl Iterator<Item = &'a Cell> + Clone,
) -> Result<(), Error> {
    let is_there: Vec<i16> = cells.clone().map(|cell| i16::from(*cell != Cell::Empty)).collect();
    let written = if description.is_double {
        let values: Vec<f64> =
            cells.filter_map(|cell| if let Cell::Double(x) = cell { Some(*x) } else { None }).collect();
        column.typed::<DoubleType>().write_batch(&values, Some(&is_there), None)
    } else {
        let text = |cell: &Cell| if let Cell::Text(text) = cell { Some(ByteArray::from(text.as_str())) } else { None };
        let values: Vec<ByteArray> = cells.filter_map(text).collect();
        column.typed::<ByteArrayType>().write_batch(&values, Some(&is_there), None)
    };
    written.map(drop).map_err(failed)
}

fn failed(error: ParquetError) -> Error {
    let error = if let ParquetError::External(error) = error { error } else { error.into() };
    match error.downcast::<io::Error>() {
        Ok(error) => Error::from(*error),
        Err(error) => Error::Output(io::Error::other(error.to_string())),
    }
}

impl Table for ParquetTable {
    fn row(&mut self, cells: &[Cell]) -> Result<(), Error> {
        self.rows.push(cells.to_vec());
        if self.rows.len() == GROUP { self.write_group() } else { Ok(()) }
    }

    fn finish(mut self: Box<Self>) -> Result<WholeFile, Error> {
        self.write_group()?;
        self.writer.into_inner().map_err(failed)
    }
}
