//! The tests of studies, as one program.

mod emit {
    mod c;
    mod emitted;
}
mod sweeps {
    mod examples;
    mod pictures;
    mod tables;
    mod together;
}
mod work_precision {
    mod advice;
    mod study;
}
