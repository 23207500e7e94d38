//! Some runs of a plan, which one thread makes: those that can be are computed [together](crate::sweeps::together).

use std::sync::atomic::AtomicBool;

use shadowstep_scenes::family::Parsed;
use shadowstep_scenes::lanes::LANES;
use shadowstep_scenes::{Error, Scene};

use crate::sweeps::plan::SweepPlan;
use crate::sweeps::record::{Record, measured};
use crate::sweeps::together::{self, allows, are_alike, suits};

/// Several times as many runs as are computed together, so that those that are not alike find others.
const MOST_RUNS: usize = 4 * LANES;

impl SweepPlan {
    /// How many runs a thread takes at once.
    pub(crate) fn batch(&self) -> usize {
        if allows(&self.keep) { MOST_RUNS } else { 1 }
    }

    /// Makes these runs, and gives the record of each to `each` when it is made; runs that were stopped have none.
    ///
    /// # Errors
    /// Those of `each`.
    pub(crate) fn make(
        &self,
        parsed: &Parsed<'_>,
        runs: &[u64],
        stops: &AtomicBool,
        mut each: impl FnMut(Record) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let keep = &self.keep;
        let mut scenes = Vec::new();
        for &run in runs {
            match parsed.scene(&self.axes().values(run)) {
                Ok(scene) => scenes.push((run, scene)),
                Err(faults) => each(Record::failed(run, faults.0[0].message.clone()))?,
            }
        }
        for group in groups(scenes) {
            let all: Vec<&Scene> = group.iter().map(|(_, scene)| scene).collect();
            let found = match all.len() > 1 && allows(keep) && suits(all[0], keep) {
                true => together::measure(&all, keep, stops),
                false => vec![None; all.len()],
            };
            for ((run, scene), values) in group.iter().zip(found) {
                let record = match values {
                    Some(values) => Some(Record::of(*run, values)),
                    None => measured(*run, scene, keep, stops),
                };
                record.map_or(Ok(()), &mut each)?;
            }
        }
        Ok(())
    }
}

/// Runs that are alike, as many as there are lanes.
fn groups(scenes: Vec<(u64, Scene)>) -> Vec<Vec<(u64, Scene)>> {
    let mut groups: Vec<Vec<(u64, Scene)>> = Vec::new();
    for (run, scene) in scenes {
        let has_place = |group: &&mut Vec<(u64, Scene)>| group.len() < LANES && are_alike(&group[0].1, &scene);
        match groups.iter_mut().find(has_place) {
            Some(group) => group.push((run, scene)),
            None => groups.push(vec![(run, scene)]),
        }
    }
    groups
}
