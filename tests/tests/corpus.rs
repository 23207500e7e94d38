//! Protects the readers: each reads every input that fuzzing found, and those from which it begins, without a panic.

use std::fs;
use std::path::Path;

use shadowstep_tests::readers::READERS;

#[test]
fn the_corpus_is_read() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../evidence/fuzz/corpus");
    for (name, reader) in READERS {
        let files = fs::read_dir(corpus.join(name)).unwrap().map(|entry| entry.unwrap().path());
        let mut files: Vec<_> = files.collect();
        files.sort();
        assert!(files.len() >= 10, "{name}");
        for file in files {
            println!("{}", file.display()); // the last one is the culprit
            reader(&fs::read(&file).unwrap());
        }
    }
}
