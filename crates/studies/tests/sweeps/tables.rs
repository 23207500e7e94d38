//! CSV and Parquet hold the same: exact values as texts with the doubles nearest to them beside.

use std::fs::{self, File};
use std::path::Path;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use shadowstep_studies::sweeps::{Collected, Manifest, SweepPlan, TableFormat, collect, compute};

const SWEEP: &str = r#"
[problem]
potential = "-k*q^4"
coordinates = ["q"]
[initial]
q = ["1/c"]
p = [0]
[run]
scheme = "$scheme"
step = "h"
steps = 40
digits = 25
[axes]
scheme = ["stormer-verlet", "ruth3"]
k = [-1, "1/300"]
c = [1, 3, 0]
h = { draws = 3, log = ["1/100", "1/10"], seed = 5 }
[keep]
values = ["verdict", "energy_error"]
first_time = { small = "q < 1/4", "large" = "q > 1" }
at_end = { "word, with \"quotes\"" = "q" }
"#;

type Rows = Vec<Vec<Option<String>>>;

fn csv(path: &Path) -> (Vec<String>, Vec<String>, Rows) {
    let text = fs::read_to_string(path).unwrap();
    let head = text.lines().filter_map(|line| line.strip_prefix("# ")).map(str::to_owned).collect();
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let names = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let field = |text: &str| (!text.is_empty()).then(|| text.to_owned());
    let rows = reader.records().map(|row| row.unwrap().iter().map(field).collect()).collect();
    (head, names, rows)
}

fn parquet(path: &Path) -> (Vec<String>, Vec<String>, Rows) {
    let reader = SerializedFileReader::new(File::open(path).unwrap()).unwrap();
    let metadata = reader.metadata().file_metadata();
    let pairs = metadata.key_value_metadata().unwrap().iter();
    let head = pairs.map(|pair| format!("{}: {}", pair.key, pair.value.as_ref().unwrap())).collect();
    let names = metadata.schema_descr().columns().iter().map(|column| column.name().to_owned()).collect();
    let field = |field: &Field| match field {
        Field::Null => None,
        Field::Str(text) => Some(text.clone()),
        Field::Double(double) => Some(double.to_string()),
        other => panic!("{other:?}"),
    };
    let rows = reader.get_row_iter(None).unwrap();
    let rows = rows.map(|row| row.unwrap().get_column_iter().map(|(_, value)| field(value)).collect()).collect();
    (head, names, rows)
}

#[test]
fn both_formats_hold_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let (path, out) = (folder.path().join("sweep.toml"), folder.path().join("out"));
    fs::write(&path, SWEEP).unwrap();
    let plan = SweepPlan::open(&path).unwrap();
    let manifest = Manifest::begin(&out, &plan, None).unwrap();
    let computed = compute(&plan, &manifest, &out, manifest.all_chunks(), &mut ()).unwrap();
    assert_eq!((computed.runs, computed.failed), (36, 12), "{computed:?}");
    for format in [TableFormat::Csv, TableFormat::Parquet] {
        let collected = collect(&out, format, &mut ()).unwrap();
        assert!(matches!(collected, Collected::Complete { runs: 36, failed: 12, .. }), "{collected:?}");
    }
    let (csv, parquet) = (csv(&out.join("results.csv")), parquet(&out.join("results.parquet")));
    assert_eq!(csv, parquet);
    let (head, names, rows) = csv;
    assert_eq!((head.len(), head[3].as_str(), rows.len()), (4, "runs: 36", 36));
    // the double beside a text is the one nearest to it
    for (place, name) in names.iter().enumerate().filter(|(_, name)| name.ends_with("_double")) {
        assert_eq!(names[place - 1], name.trim_end_matches("_double"));
        for row in &rows {
            let nearest = row[place - 1].as_ref().map(|text| {
                let double: f64 = shadowstep::Number::from_rational(&shadowstep::exact(text).unwrap(), &());
                double.to_string()
            });
            assert_eq!(row[place], nearest, "{name}: {row:?}");
        }
    }
    assert!(names.contains(&"word, with \"quotes\"".to_owned()));
}
