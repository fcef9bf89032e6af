//! The example on the README's first screen is what the program prints.
use std::process::Command;

#[test]
fn the_report_in_the_readme_is_the_one_printed() {
    let root = env!("CARGO_MANIFEST_DIR");
    let readme = std::fs::read_to_string(format!("{root}/README.md")).unwrap();
    let (_, rest) = readme
        .split_once("```text\n")
        .expect("the README shows a report");
    let (shown, _) = rest.split_once("\n```").expect("the block ends");
    let run = Command::new(env!("CARGO_BIN_EXE_kutzbach"))
        .args(["report", "mechanisms/bennett.urdf"])
        .current_dir(root)
        .env_remove("COLUMNS")
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    assert_eq!(
        shown.trim_end(),
        String::from_utf8(run.stdout).unwrap().trim_end()
    );
}
