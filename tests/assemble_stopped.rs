//! `kutzbach assemble` where it is stopped: by Ctrl-C, or by its budget.

#[cfg(unix)]
use std::process::Stdio;

/// Exact algebra on this loop of six hinges takes minutes.
const LONG: &str = "tests/zoo/general_6r_rigid.urdf";

/// What is printed where Ctrl-C is pressed after some time.
#[cfg(unix)]
fn interrupted_after(milliseconds: u64) -> String {
    let child = crate::support::program()
        .args(["assemble", LONG, "--budget", "60"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(milliseconds));
    crate::support::press_ctrl_c(&child);
    let asked = std::time::Instant::now();
    let output = child.wait_with_output().unwrap();
    assert!(asked.elapsed().as_secs() < 20);
    assert_eq!(output.status.code(), Some(130));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[cfg(unix)]
#[test]
fn ctrl_c_leaves_what_was_found() {
    // On a busy machine the pose drawn is looked at later.
    let mut texts = [1500, 6000, 20_000].into_iter().map(interrupted_after);
    let found = texts.find(|text| text.contains("Configuration 1 (drawn"));
    let text = found.expect("the pose drawn is found within 20 s");
    assert!(text.contains("was interrupted"), "{text}");
}

#[test]
fn a_budget_is_kept() {
    let began = std::time::Instant::now();
    let output = crate::support::program()
        .args(["assemble", LONG, "--budget", "1"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("the time limit was reached"), "{text}");
    assert!(began.elapsed().as_secs() < 20);
}
