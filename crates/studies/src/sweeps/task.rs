//! Which chunk a task of a Slurm array computes.

use crate::Error;
use crate::sweeps::chunk::Chunk;

/// The number of the task.
const ID: &str = "SLURM_ARRAY_TASK_ID";
/// How many tasks the array has; of an array that repeats some chunks only, fewer than there are chunks.
const COUNT: &str = "SLURM_ARRAY_TASK_COUNT";
/// The least number of a task.
const MIN: &str = "SLURM_ARRAY_TASK_MIN";
const MAX: &str = "SLURM_ARRAY_TASK_MAX";

/// The chunk of this task, from the variables of the environment; `None` outside of arrays. `chunks` is the number of
/// chunks of a folder that has been begun; in a new one, the array decides, whose tasks must be 1, 2, … then.
///
/// ```
/// use shadowstep_studies::sweeps::{Chunk, chunk_of_task};
///
/// let array = |name: &str| match name {
///     "SLURM_ARRAY_TASK_ID" => Some("3".to_owned()),
///     "SLURM_ARRAY_TASK_COUNT" => Some("16".to_owned()),
///     _ => None,
/// };
/// assert_eq!(chunk_of_task(array, None).unwrap(), Some(Chunk { number: 3, of: 16 }));
/// // a task of an array of 16 in a folder of 20 chunks
/// assert_eq!(chunk_of_task(array, Some(20)).unwrap(), Some(Chunk { number: 3, of: 20 }));
/// ```
///
/// # Errors
/// Variables that are not numbers; an array that does not begin with 1; a number beyond the chunks.
pub fn chunk_of_task(get: impl Fn(&str) -> Option<String>, chunks: Option<u64>) -> Result<Option<Chunk>, Error> {
    let Some(id) = get(ID) else { return Ok(None) };
    let number = number(ID, &id)?;
    let of = match chunks {
        Some(chunks) => chunks,
        None => {
            let count = get(COUNT).ok_or_else(|| {
                Error::usage(format!("{ID} is set, but {COUNT} is not"), "give the chunk with --chunk I/N")
            })?;
            let count = self::number(COUNT, &count)?;
            let is_from_one =
                get(MIN).is_none_or(|min| min == "1") && get(MAX).is_none_or(|max| max == count.to_string());
            if !is_from_one {
                let hint = format!("submit it with --array=1-{count}, or give the chunk with --chunk I/N");
                return Err(Error::usage("the tasks of this array are not numbered 1, 2, …", hint));
            }
            count
        }
    };
    if !(1..=of).contains(&number) {
        let hint = format!("submit it with --array=1-{of}, or a part of that");
        return Err(Error::usage(format!("{ID} is {number}, and the chunks are 1 to {of}"), hint));
    }
    Ok(Some(Chunk { number, of }))
}

fn number(name: &str, text: &str) -> Result<u64, Error> {
    text.parse()
        .map_err(|_| Error::usage(format!("{name} is `{text}`, not a number"), "give the chunk with --chunk I/N"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(variables: &[(&str, &str)], chunks: Option<u64>) -> Result<Option<Chunk>, String> {
        let get = |name: &str| variables.iter().find(|(own, _)| *own == name).map(|(_, value)| (*value).to_owned());
        chunk_of_task(get, chunks).map_err(|error| error.to_string())
    }

    #[test]
    fn an_array_decides_where_the_folder_is_new() {
        assert_eq!(of(&[], None), Ok(None));
        let chunk = Chunk { number: 2, of: 4 };
        assert_eq!(of(&[(ID, "2"), (COUNT, "4"), (MIN, "1"), (MAX, "4")], None), Ok(Some(chunk)));
        let refused = of(&[(ID, "2"), (COUNT, "4"), (MIN, "0"), (MAX, "3")], None).unwrap_err();
        assert!(refused.contains("not numbered 1, 2, …") && refused.contains("--array=1-4"), "{refused}");
        let refused = of(&[(ID, "x"), (COUNT, "4")], None).unwrap_err();
        assert!(refused.contains("SLURM_ARRAY_TASK_ID is `x`"), "{refused}");
    }

    /// Tasks 3 and 7 of 16 are repeated: their array has two tasks.
    #[test]
    fn an_array_of_missing_chunks_keeps_their_numbers() {
        let again = [(ID, "7"), (COUNT, "2"), (MIN, "3"), (MAX, "7")];
        assert_eq!(of(&again, Some(16)), Ok(Some(Chunk { number: 7, of: 16 })));
        let refused = of(&again, None).unwrap_err();
        assert!(refused.contains("not numbered 1, 2, …"), "{refused}");
        let refused = of(&[(ID, "17"), (COUNT, "1")], Some(16)).unwrap_err();
        assert!(refused.contains("is 17, and the chunks are 1 to 16"), "{refused}");
    }
}
