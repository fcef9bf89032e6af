//! What the tests of whole mechanisms share: finding files, running over them on two cores, and listing what went wrong.

pub mod combine;
pub mod decimal;
pub mod drawn;
pub mod exported;
pub mod rewrite;
pub mod step_text;
pub mod whole_numbers;

use kutzbach::matrix::SplitMix64;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, analyse};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The program, built with these tests.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_kutzbach");

/// The program, to be started without anything of whoever runs the tests: neither the width and colours of a terminal nor
/// folders of packages, home, locale or time zone.
pub fn program() -> Command {
    let mut program = Command::new(PROGRAM);
    program.env_clear();
    // Without it no program of Windows starts.
    program.envs(std::env::var_os("SystemRoot").map(|root| ("SystemRoot", root)));
    program
}

/// Sends a process what Ctrl-C sends; it must not have ended. Every shell has `kill` built in, not every machine a program.
#[cfg(unix)]
pub fn press_ctrl_c(process: &std::process::Child) {
    let sent = Command::new("sh")
        .args(["-c", "kill -INT \"$1\"", "sh", &process.id().to_string()])
        .status()
        .unwrap();
    assert!(sent.success(), "it had ended before");
}

/// A folder of its own for one test, empty.
pub fn empty_folder(test: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// A folder of the package.
pub fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// A folder of the material that lies beside the repository and is not part of it: under `KUTZBACH_SHARED`, or `../shared`.
/// Only tests that are ignored ask for it; where it is missing they fail.
pub fn shared(name: &str) -> PathBuf {
    let root =
        std::env::var_os("KUTZBACH_SHARED").map_or_else(|| folder("../shared"), PathBuf::from);
    let path = root.join(name);
    assert!(
        path.is_dir(),
        "there is no folder {}; set KUTZBACH_SHARED",
        path.display()
    );
    path
}

/// The mechanism files of a folder with their stems, by name.
pub fn mechanism_files(folder: &Path) -> Vec<(String, PathBuf)> {
    let mut files: Vec<(String, PathBuf)> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "urdf"))
        .map(|path| {
            (
                path.file_stem().unwrap().to_string_lossy().into_owned(),
                path,
            )
        })
        .collect();
    files.sort();
    files
}

/// The reference mechanisms of `tests/zoo`.
pub fn zoo() -> Vec<(String, Mechanism)> {
    read_all(&folder("tests/zoo"))
}

/// The mechanisms of `mechanisms/`.
pub fn own_mechanisms() -> Vec<(String, Mechanism)> {
    read_all(&folder("mechanisms"))
}

fn read_all(folder: &Path) -> Vec<(String, Mechanism)> {
    mechanism_files(folder)
        .into_iter()
        .map(|(name, path)| {
            let reading = kutzbach::format::read_file(&path, &[]).unwrap_or_else(|e| panic!("{e}"));
            (name, reading.mechanism)
        })
        .collect()
}

/// One mechanism of the zoo.
pub fn zoo_mechanism(name: &str) -> Mechanism {
    let path = folder("tests/zoo").join(format!("{name}.urdf"));
    kutzbach::format::read_file(path, &[]).unwrap().mechanism
}

/// The analysis at the home pose.
pub fn analysis(mechanism: &Mechanism) -> Analysis {
    analyse(mechanism, &AnalysisOptions::default())
        .unwrap_or_else(|error| panic!("{}: {error}", mechanism.name()))
}

/// A mechanism of a folder with its name and its analysis at the home pose.
pub type Known = (String, Mechanism, Analysis);

fn analysed(mechanisms: Vec<(String, Mechanism)>) -> Vec<Known> {
    let analyses = in_parallel(&mechanisms, |(_, mechanism)| analysis(mechanism));
    let pairs = mechanisms.into_iter().zip(analyses);
    pairs.map(|((n, m), analysis)| (n, m, analysis)).collect()
}

/// The reference mechanisms, analysed once for all tests that ask.
pub static KNOWN_ZOO: LazyLock<Vec<Known>> = LazyLock::new(|| analysed(zoo()));

/// The mechanisms of `mechanisms/`, analysed once for all tests that ask.
pub static KNOWN_OWN: LazyLock<Vec<Known>> = LazyLock::new(|| analysed(own_mechanisms()));

/// The names of joints, or parts of joints, that an analysis calls locked; a joint without freedoms is never named.
pub fn locked_names(mechanism: &Mechanism, analysis: &Analysis) -> BTreeSet<String> {
    mechanism
        .joints()
        .iter()
        .zip(&analysis.roles)
        .flat_map(|(joint, role)| {
            let whole = (role.locked == Some(true)).then(|| joint.name.clone());
            whole.into_iter().chain(role.locked_parts.iter().cloned())
        })
        .collect()
}

/// Whether a joint, or a part of it, is among the names that [`locked_names`] gives. Where a joint's freedoms of one sort
/// count one by one (`table.rot1`, `table.rot2`), the sort as a whole (`table.rot`) is locked when all of them are.
pub fn is_locked(name: &str, found: &BTreeSet<String>, mechanism: &Mechanism) -> bool {
    let numbered = || {
        let (joint, sort) = name.rsplit_once('.')?;
        let joint = &mechanism.joints()[mechanism.joint_named(joint)?.0];
        let freedoms = joint.kind.freedoms().iter();
        let count = freedoms.filter(|f| f.suffix() == sort).count();
        Some(count > 0 && (1..=count).all(|i| found.contains(&format!("{name}{i}"))))
    };
    found.contains(name) || numbered().unwrap_or(false)
}

/// Whether everything is to be looked at that a sample is drawn from otherwise: `bash .ci/on-demand whole`.
pub fn whole() -> bool {
    std::env::var_os("KUTZBACH_WHOLE").is_some()
}

/// What a count has to reach: the number given of everything, a fifth of it where [`sample`] drew about a third.
pub fn at_least(of_all: usize) -> usize {
    if whole() { of_all } else { of_all / 5 }
}

/// About one in so many, drawn by lot and the same every time; `KUTZBACH_SEED` draws others, [`whole`] takes all.
pub fn sample<T>(items: impl IntoIterator<Item = T>, one_in: u64) -> Vec<T> {
    let seed = std::env::var("KUTZBACH_SEED").map_or(20260, |seed| seed.parse().unwrap());
    let mut lots = SplitMix64::new(seed);
    let mut drawn = |_: &T| whole() || lots.next_u64().is_multiple_of(one_in);
    let chosen: Vec<T> = items.into_iter().filter(&mut drawn).collect();
    assert!(!chosen.is_empty(), "nothing was drawn");
    chosen
}

/// Maps over items on two threads; the results keep the items' order.
pub fn in_parallel<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let mut done: Vec<(usize, R)> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..2)
            .map(|_| {
                scope.spawn(|| {
                    let mut done = Vec::new();
                    loop {
                        let index = next.fetch_add(1, Ordering::Relaxed);
                        let Some(item) = items.get(index) else {
                            return done;
                        };
                        done.push((index, work(item)));
                    }
                })
            })
            .collect();
        workers
            .into_iter()
            .flat_map(|worker| worker.join().unwrap())
            .collect()
    });
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Fails with every line at once.
pub fn assert_none(wrong: &[String]) {
    assert!(
        wrong.is_empty(),
        "{} disagreements:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

/// The file of a mechanism that is made for a test, in a folder for such files.
pub fn written(mechanism: &Mechanism) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let file = folder.join(format!("{}.urdf", mechanism.name()));
    std::fs::write(&file, kutzbach::format::write(mechanism)).unwrap();
    file
}

/// Instructions that the program built with these tests executes for a report on a mechanism, as valgrind counts them: a third more
/// than an optimised one.
pub fn instructions(mechanism: &Mechanism) -> u64 {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(PROGRAM)
        .arg("report")
        .arg(written(mechanism))
        .output()
        .expect("valgrind has to be installed");
    let told = String::from_utf8_lossy(&output.stderr);
    // ==123== Collected : 4567
    let count = told
        .lines()
        .find_map(|line| line.split_once("Collected : "))
        .and_then(|(_, count)| count.trim().parse().ok());
    count.unwrap_or_else(|| panic!("no count for {}: {told}", mechanism.name()))
}
