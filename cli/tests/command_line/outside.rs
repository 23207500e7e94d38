//! The files that a scene or a sweep names lie in its folder or below, unless `--allow-outside` is given; of files that
//! are something else, no line is shown.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::program::{Finished, shadowstep};

const RUN: &str = "[run]\nscheme = \"SCHEME\"\nstep = \"1/20\"\nsteps = 20\ndigits = \"double\"\n";

const KEPLER: &str = "[problem]\nname = \"kepler\"\n";

const SUN: &str = "[problem]\nparameters.g = 40\n";

const BODIES: &str = "[[body]]\nname = \"sun\"\nmass = 1\n[[body]]\nname = \"jupiter\"\nmass = 0.001\na = 5\n";

/// A line of a file that no message shows.
const SECRET: &str = "root:$6$topsecret:19000";

/// Scenes and sweeps in which FILE is the name of a file that is read or written; what is a good content for one that
/// is read.
fn texts() -> Vec<(&'static str, String, Option<&'static str>)> {
    let run = RUN.replace("SCHEME", "yoshida4");
    let table = "name = \"mine\"\norder = 2\nkinetic = \"any\"\nsymmetric = true\nreference = \"L. Verlet\"\n\
                 [composition]\nbase = \"stormer-verlet\"\ngamma = [\"1\"]\n";
    let energy = "[output]\nenergy = true\n";
    let planets = RUN.replace("SCHEME", "saba4");
    vec![
        ("out.csv", format!("{KEPLER}{run}{energy}file = \"FILE\"\n"), None),
        ("out.svg", format!("{KEPLER}{run}{energy}file = \"rows.csv\"\nplot = \"FILE\"\n"), None),
        ("out.svg", format!("{KEPLER}{run}{energy}file = \"rows.csv\"\nplot = {{ file = \"FILE\" }}\n"), None),
        ("mine.toml", format!("{KEPLER}{}{energy}", RUN.replace("SCHEME", "FILE")), Some(table)),
        ("p.csv", format!("{SUN}particles = \"FILE\"\n{BODIES}{planets}{energy}"), Some("name,a,e\nx,3,0.1\n")),
        (
            "c.csv",
            format!("{KEPLER}parameters.eccentricity = \"e\"\n{run}{energy}[ensemble]\nfile = \"FILE\"\n"),
            Some("e\n0.1\n0.2\n"),
        ),
    ]
}

/// A folder `own` with a scene, and `other` beside it.
fn folders(scene: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["own", "own/below", "other"] {
        fs::create_dir(folder.path().join(name)).unwrap();
    }
    fs::write(folder.path().join("own/scene.toml"), scene).unwrap();
    folder
}

fn run(folder: &Path, flags: &str) -> Finished {
    shadowstep(&format!("run {} --no-summary {flags}", folder.join("own/scene.toml").display()))
}

fn other_files(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder.join("other")).unwrap().map(|entry| entry.unwrap().path()).collect()
}

#[test]
fn files_outside_of_the_folder_need_a_flag() {
    for (name, scene, content) in texts() {
        let place = |folder: &Path, at: &str| match at {
            "absolute" => folder.join("other").join(name).display().to_string(),
            at => format!("{at}{name}"),
        };
        for at in ["absolute", "../other/", "below/../../other/", "linked/"] {
            let folder = folders("");
            let here = folder.path();
            #[cfg(unix)]
            std::os::unix::fs::symlink("../other", here.join("own/linked")).unwrap();
            let path = place(here, at);
            fs::write(here.join("own/scene.toml"), scene.replace("FILE", &path)).unwrap();
            content.iter().for_each(|content| fs::write(here.join("other").join(name), content).unwrap());
            let before = other_files(here);
            let result = run(here, "");
            assert_eq!(result.code, 2, "{path}: {}", result.err);
            let wanted = format!("`{path}` is outside of the folder of this file");
            assert!(result.err.contains(&wanted) && result.err.contains("--allow-outside"), "{}", result.err);
            assert_eq!(other_files(here), before, "{path}");
            let result = run(here, "--allow-outside");
            assert_eq!(result.code, 0, "{path}: {}", result.err);
            assert!(here.join("other").join(name).exists());
        }
        for at in ["", "below/", "./", "below/../", "../own/", "own absolute"] {
            let folder = folders("");
            let own = folder.path().join("own");
            let path = if at == "own absolute" { own.join(name).display().to_string() } else { format!("{at}{name}") };
            fs::write(own.join("scene.toml"), scene.replace("FILE", &path)).unwrap();
            content.iter().for_each(|content| fs::write(own.join(&path), content).unwrap());
            let result = run(folder.path(), "");
            assert_eq!((result.code, result.err.as_str()), (0, ""), "{path}");
        }
    }
}

/// A file of the folder that is a link to one outside of it.
#[cfg(unix)]
#[test]
fn links_out_of_the_folder_leave_it() {
    for (name, scene, content) in texts() {
        let folder = folders(&scene.replace("FILE", name));
        let target = folder.path().join("other").join(name);
        fs::write(&target, content.unwrap_or("precious")).unwrap();
        std::os::unix::fs::symlink(&target, folder.path().join("own").join(name)).unwrap();
        let result = run(folder.path(), "--force");
        assert!(result.code == 2 && result.err.contains("is outside of the folder"), "{name}: {}", result.err);
        assert_eq!(fs::read_to_string(&target).unwrap(), content.unwrap_or("precious"));
    }
}

#[test]
fn no_line_of_a_file_that_is_something_else_is_shown() {
    for (name, scene, _) in texts().into_iter().filter(|(.., content)| content.is_some()) {
        for secret in [
            SECRET.to_owned(),
            format!("{SECRET}\n{SECRET}\n"),
            format!("token = \"{SECRET}\"\n"),
            format!("a,{SECRET}\n1,{SECRET}\n"),
        ] {
            let folder = folders(&scene.replace("FILE", name));
            fs::write(folder.path().join("own").join(name), secret).unwrap();
            for command in
                ["run @ --no-summary", "run @ --allow-outside", "drift @ --scheme ruth3 --step 1/10 --until 1"]
            {
                let scene = folder.path().join("own/scene.toml").display().to_string();
                let result = shadowstep(&command.replace('@', &scene));
                assert!(!result.err.contains("topsecret") && !result.out.contains("topsecret"), "{}", result.err);
                assert!(command.starts_with("drift") || result.code == 2, "{}", result.err);
            }
        }
    }
}

#[test]
fn a_sweep_names_files_of_its_folder() {
    let keep = "[axes]\nh = [\"1/20\", \"1/40\"]\n[keep]\nvalues = [\"steps\"]\n";
    let scene = format!("{KEPLER}{}", RUN.replace("SCHEME", "ruth3").replace("\"1/20\"", "\"h\""));
    let schemes = format!(
        "{KEPLER}{}[axes]\ns = [\"ruth3\", \"../other/x.toml\"]\n[keep]\nvalues = [\"steps\"]\n",
        RUN.replace("SCHEME", "$s")
    );
    for (sweep, file) in [(format!("scene = \"../other/x.toml\"\n{keep}"), scene), (schemes, SECRET.to_owned())] {
        let folder = folders("");
        let own = folder.path().join("own");
        fs::write(own.join("sweep.toml"), &sweep).unwrap();
        fs::write(folder.path().join("other/x.toml"), &file).unwrap();
        let sweep = format!("sweep {} --out {}", own.join("sweep.toml").display(), own.join("out").display());
        let result = shadowstep(&sweep);
        assert!(result.code == 2 && result.err.contains("is outside of the folder"), "{}", result.err);
        let result = shadowstep(&format!("{sweep} --allow-outside"));
        let is_scene = file != SECRET;
        assert_eq!(result.code, if is_scene { 0 } else { 2 }, "{}", result.err);
        assert!(!result.err.contains("topsecret"), "{}", result.err);
    }
}
