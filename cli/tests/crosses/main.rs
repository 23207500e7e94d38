//! Crosses: everything that a scene may have, with everything that is done with a scene. Each cell works, with
//! plausible results, or is refused by one sentence that says why; each row has a variant with a fault, which is
//! refused with its place. What is refused is in docs/what-works-with-what.md, which this test keeps true, so that a
//! cell that worked cannot become one that is refused unseen.
#![cfg(target_os = "linux")]

mod commands;
mod page;
#[path = "../../../tests/src/pages.rs"]
pub mod pages;
mod rows;
#[path = "../faults/shim.rs"]
mod shim;

use rayon::prelude::*;

use commands::{COLUMNS, Cell, Column, Outcome};
use page::{Page, Table};
use rows::{Row, Scene, rows};

/// The system of all runs, and the run of all systems.
const SYSTEM: &str = "kepler";
const RUN: &str = "double";

fn find<'a>(rows: &'a [Row], name: &str) -> &'a Row {
    rows.iter().find(|row| row.name == name).unwrap()
}

/// The cells of a table, whose faults are collected.
fn table(scenes: &[Vec<(Scene, Column)>], faults: &mut Vec<String>) -> Vec<Vec<Cell>> {
    let all: Vec<&(Scene, Column)> = scenes.iter().flatten().collect();
    let outcomes: Vec<Outcome> = all.par_iter().map(|(scene, column)| column.of(scene)).collect();
    let mut cells = all.iter().zip(outcomes).map(|((scene, column), outcome)| {
        outcome.unwrap_or_else(|fault| {
            faults.push(format!("{}, {}, {}: {fault}", scene.system.name, scene.run.name, column.name));
            Cell::Works
        })
    });
    scenes.iter().map(|row| cells.by_ref().take(row.len()).collect()).collect()
}

/// Without MPFR its rows are refused, and the page is not that of this program.
fn is_here(run: &Row) -> bool {
    cfg!(feature = "mpfr") || !run.title.ends_with("by MPFR")
}

#[test]
fn every_cell_works_or_says_why() {
    let (systems, runs) = (rows("systems"), rows("runs"));
    let runs: Vec<Row> = runs.into_iter().filter(is_here).collect();
    let scene = |system: &Row, run: &Row| Scene { system: system.clone(), run: run.clone() };
    let mut faults = Vec::new();
    let in_all_columns = |scene: Scene| COLUMNS.iter().map(|column| (scene.clone(), *column)).collect();
    let commands = || COLUMNS.iter().map(|column| column.name.to_owned()).collect();
    let of_systems: Vec<Vec<_>> =
        systems.iter().map(|system| in_all_columns(scene(system, find(&runs, RUN)))).collect();
    let of_runs: Vec<Vec<_>> = runs.iter().map(|run| in_all_columns(scene(find(&systems, SYSTEM), run))).collect();
    let made = |system: &Row| runs.iter().map(|run| (scene(system, run), COLUMNS[0])).collect();
    let of_both: Vec<Vec<_>> = systems.iter().map(made).collect();
    let page = Page {
        systems: Table { rows: &systems, columns: commands(), cells: table(&of_systems, &mut faults) },
        runs: Table { rows: &runs, columns: commands(), cells: table(&of_runs, &mut faults) },
        both: Table {
            rows: &systems,
            columns: runs.iter().map(|run| run.name.clone()).collect(),
            cells: table(&of_both, &mut faults),
        },
    };
    assert!(faults.is_empty(), "{} cells:\n\n{}", faults.len(), faults.join("\n\n"));
    if cfg!(feature = "mpfr") {
        pages::assert_page("docs/what-works-with-what.md", &page.to_string());
    }
    let (refused, cells) = (page.refused(), page.cells());
    // schemes for one kind of system are refused by most others
    assert!(9 * refused < cells, "{refused} of {cells} cells are refused");
}

#[test]
fn every_fault_is_refused_with_its_place() {
    let (systems, runs) = (rows("systems"), rows("runs"));
    let of_systems = systems.iter().map(|system| (system.faulty(), find(&runs, RUN).clone(), false));
    let of_runs = runs.iter().map(|run| (find(&systems, SYSTEM).clone(), run.faulty(), true));
    let scenes: Vec<(Scene, Column)> = of_systems
        .chain(of_runs)
        .flat_map(|(system, run, of_run)| {
            let columns = COLUMNS.iter().filter(move |column| column.reads_run || !of_run);
            columns.map(move |column| (Scene { system: system.clone(), run: run.clone() }, *column))
        })
        .filter(|(scene, column)| (column.without)(scene).is_none())
        .collect();
    let wrong = |(scene, column): &(Scene, Column)| {
        let name = format!("{}, {}, {}", scene.system.name, scene.run.name, column.name);
        match column.of(scene) {
            Ok(Cell::Refused { has_place: true, .. }) => None,
            other => Some(format!("{name}: {other:?}")),
        }
    };
    let found: Vec<String> = scenes.par_iter().filter_map(wrong).collect();
    assert!(found.is_empty(), "{} faults:\n\n{}", found.len(), found.join("\n\n"));
}
