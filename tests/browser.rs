//! Pages in the hands of a browser: the tests of `viewer/test` on pages that this program writes.
//!
//! `KUTZBACH_CHROMIUM` names a Chromium; `node` and the packages of `viewer/package-lock.json` (`npm ci` in `viewer`) are
//! needed too. The test is ignored: nothing but Rust is asked of whoever runs `cargo test`.

use crate::support;

use kutzbach::families::scissor_lift;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use support::folder;

fn kutzbach(arguments: &[&str], file: &Path, to: &Path) {
    let run = crate::support::program()
        .arg(arguments[0])
        .arg(file)
        .args(&arguments[1..])
        .arg("-o")
        .arg(to)
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}: {}",
        file.display(),
        String::from_utf8_lossy(&run.stderr)
    );
}

/// A page, and beside it what `kutzbach trace` says of every branch (`A`, `B`, …).
fn write(name: &str, file: &Path, branches: &[&str], more: &[&str], to: &Path) {
    let mut page = vec!["report", "--format", "html"];
    page.extend(more);
    kutzbach(&page, file, &to.join(format!("{name}.html")));
    for branch in branches {
        let trace = [
            "trace",
            "--format",
            "json",
            "--samples",
            "37",
            "--branch",
            branch,
        ];
        kutzbach(
            &trace,
            file,
            &to.join(format!("{name}.{branch}.trace.json")),
        );
    }
}

/// The pages that the tests open, by what they are to show.
fn pages(to: &Path) {
    let own = |name: &str| folder(&format!("mechanisms/{name}.urdf"));
    write("four_bar", &own("planar_four_bar"), &["A"], &[], to);
    write(
        "two_branches",
        &own("parallelogram_flat"),
        &["A", "B"],
        &[],
        to,
    );
    write(
        "slider",
        &own("slider_hitting_stop"),
        &["A"],
        &["--verify"],
        to,
    );
    write("still", &own("shaky_triangle"), &[], &[], to);
    write("locked", &own("cardan_shaft"), &["A"], &[], to);
    write("bennett", &own("bennett"), &["A"], &[], to);
    write("several_freedoms", &own("cartesian_table"), &[], &[], to);
    write(
        "unassembled",
        &folder("tests/pages/open_four_bar.urdf"),
        &[],
        &[],
        to,
    );
    write(
        "far",
        &folder("tests/pages/far_from_origin.urdf"),
        &["A"],
        &[],
        to,
    );
    write(
        "hostile",
        &folder("tests/pages/hostile_names.urdf"),
        &["A"],
        &[],
        to,
    );
    // A lift of 29 stages has 60 links.
    for (name, stages) in [("large", 29), ("hundred_stages", 100)] {
        let file = to.join(format!("{name}.urdf"));
        let text = kutzbach::format::write(&scissor_lift(stages).unwrap());
        std::fs::write(&file, text).unwrap();
        write(name, &file, &["A"], &[], to);
    }
}

#[test]
#[ignore = "needs a browser: KUTZBACH_CHROMIUM, and the packages of viewer/"]
fn pages_behave_in_a_browser() {
    let browser = std::env::var_os("KUTZBACH_CHROMIUM").filter(|name| !name.is_empty());
    let browser = browser.expect("KUTZBACH_CHROMIUM names no browser");
    let to: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join("browser");
    let _ = std::fs::remove_dir_all(&to);
    std::fs::create_dir_all(&to).unwrap();
    pages(&to);
    let node = std::env::var_os("KUTZBACH_NODE").unwrap_or_else(|| "node".into());
    let run = Command::new(node)
        .arg(folder("viewer/test/run.mjs"))
        .env("KUTZBACH_CHROMIUM", browser)
        .env("KUTZBACH_PAGES", &to)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}\n{}",
        String::from_utf8_lossy(&run.stdout),
        String::from_utf8_lossy(&run.stderr)
    );
}
