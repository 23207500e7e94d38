//! What becomes of files that are there when a run begins.

/// What becomes of a checkpoint and of files that are there when a run begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FileOptions {
    /// Begins at t = 0, whether there is a checkpoint or a complete file of this scene.
    pub restart: bool,
    /// Replaces a file that is not from this scene.
    pub force: bool,
}
