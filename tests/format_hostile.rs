//! Hostile input: texts and files built to exhaust a reader end in an error, soon.

use crate::format_support;

use format_support::{chain, fault, robot};
use kutzbach::format::{read, read_bytes, read_file};
use std::io::Write as _;
use std::path::PathBuf;

#[test]
fn deep_wide_and_long_texts_end_in_an_error_soon() {
    let started = std::time::Instant::now();
    let deep = format!(
        "<robot name='r'>{}{}</robot>",
        "<a>".repeat(100_000),
        "</a>".repeat(100_000)
    );
    assert!(fault(&deep).message.contains("64 levels"));
    let unclosed = format!("<robot name='r'>{}", "<a>".repeat(100_000));
    assert!(fault(&unclosed).message.contains("64 levels"));
    let attributes: String = (0..100_000).map(|i| format!(" a{i}='1'")).collect();
    assert!(
        fault(&format!("<robot{attributes}/>"))
            .message
            .contains("100000 attributes")
    );
    let elements = robot(&"<frob/>".repeat(100_000));
    assert!(fault(&elements).message.contains("nothing connects it"));
    let name = "x".repeat(1_000_000);
    assert!(fault(&robot(&format!("<{name}/>"))).message.chars().count() <= 1001);
    assert!(
        fault(&robot(&format!("<link {name}='1'/>")))
            .message
            .chars()
            .count()
            <= 1001
    );
    let digits = chain(
        "revolute",
        &format!("<axis xyz='0 0 {}'/>", "1".repeat(1_000_000)),
    );
    assert!(fault(&digits).message.contains("digits"));
    let numbers = chain(
        "revolute",
        &format!("<axis xyz='{}'/>", "1 ".repeat(1_000_000)),
    );
    assert!(fault(&numbers).message.contains("found 1000000"));
    let parentheses = chain(
        "revolute",
        &format!("<axis xyz='0 0 ${{{}1'/>", "(".repeat(1_000_000)),
    );
    fault(&parentheses);
    let squares: String = (1..1000)
        .map(|i| {
            format!(
                "<xacro:property name='a{i}' value='a{}*a{} + 1'/>\n",
                i - 1,
                i - 1
            )
        })
        .collect();
    fault(&robot(&format!(
        "<xacro:property name='a0' value='1.5'/>\n{squares}"
    )));
    let roots: String = (1..2000)
        .map(|i| {
            format!(
                "<xacro:property name='a{i}' value='sqrt(1 + a{})'/>\n",
                i - 1
            )
        })
        .collect();
    fault(&robot(&format!(
        "<xacro:property name='a0' value='2'/>\n{roots}"
    )));
    let later: String = (0..10_000)
        .map(|i| format!("<xacro:property name='a{i}' value='a{} + 1'/>\n", i + 1))
        .collect();
    assert!(
        fault(&robot(&format!(
            "{later}<xacro:property name='a10000' value='1'/>"
        )))
        .message
        .contains("wait")
    );
    assert!(
        started.elapsed().as_secs() < 60,
        "took {:?}",
        started.elapsed()
    );
}

/// A chain of links with a loop beside every joint, on one line if so wanted.
fn long_chain(joints: usize, between: &str) -> String {
    let mut text = format!("<robot name=\"long\">{between}<link name=\"l0\"/>{between}");
    for i in 1..=joints {
        let before = i - 1;
        text += &format!(
            "<link name=\"l{i}\"><visual><geometry><sphere radius=\"0.1\"/></geometry><material name=\"m\"/></visual></link>{between}\
             <joint name=\"j{i}\" type=\"revolute\"><parent link=\"l{before}\"/><child link=\"l{i}\"/>\
             <origin xyz=\"0.1234 -5.25 {i}e-3\" rpy=\"0 0.5 1.570796\"/><axis xyz=\"0 0.6 0.8\"/></joint>{between}"
        );
    }
    text + "</robot>"
}

#[test]
fn bytes_that_are_not_text() {
    let text = robot("<link name='X'/>");
    let mut bytes = text.clone().into_bytes();
    let at = text.find('X').unwrap();
    bytes[at] = 0xe9;
    let error = read_bytes(&bytes, "latin.urdf", &[]).unwrap_err();
    assert_eq!(
        (error.line, error.column, error.span.clone()),
        (3, 13, at..at + 1)
    );
    assert!(error.message.contains("0xe9"));
    let wide: Vec<u8> = "\u{feff}<robot/>"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    assert!(
        read_bytes(&wide, "f", &[])
            .unwrap_err()
            .message
            .contains("UTF-16")
    );
    assert!(read_bytes(&[], "f", &[]).is_err());
    assert!(read_bytes(&[0; 100], "f", &[]).is_err());
    let marked = format!("\u{feff}{}", chain("revolute", ""));
    assert_eq!(read(&marked, "f", &[]).unwrap().mechanism.joints().len(), 2);
}

/// A file in a folder of the tests' own that is removed when dropped.
struct Temporary(PathBuf);

impl Temporary {
    fn new(name: &str) -> Self {
        Self(PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name))
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

#[test]
fn files_that_cannot_be_read() {
    let large = Temporary::new("large.urdf");
    let mut file = std::fs::File::create(&large.0).unwrap();
    file.write_all(b"<robot name='r'>").unwrap();
    // Sparse: 200 MB that take no room on the disk.
    file.set_len(200_000_000).unwrap();
    let started = std::time::Instant::now();
    let error = read_file(&large.0, &[]).unwrap_err();
    assert!(error.message.contains("within 2 GB of memory"), "{error}");
    let help = error.help.as_deref().unwrap_or_default();
    assert!(help.contains("`--memory 4` allows"), "{help}");
    assert!(
        started.elapsed().as_millis() < 1000,
        "a large file is refused unread"
    );

    let missing = Temporary::new("missing.urdf");
    let error = read_file(&missing.0, &[]).unwrap_err();
    assert!(error.message.contains("cannot be read"), "{error}");
    assert_eq!((error.line, error.column), (1, 1));
    let error = read_file(env!("CARGO_TARGET_TMPDIR"), &[]).unwrap_err();
    assert!(
        error.message.contains("directory") || error.message.contains("cannot be read"),
        "{error}"
    );

    let good = Temporary::new("good.urdf");
    std::fs::write(&good.0, chain("revolute", "")).unwrap();
    assert_eq!(read_file(&good.0, &[]).unwrap().mechanism.freedom(), 1);
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn reading_takes_time_in_proportion_to_the_text() {
        for between in ["\n", ""] {
            let small = long_chain(3_000, between);
            let large = long_chain(30_000, between);
            let time = |text: &str| {
                let started = std::time::Instant::now();
                let reading = read(text, "long", &[]).unwrap();
                (started.elapsed(), reading.skipped[0].count)
            };
            let (_, warm) = time(&small);
            let (short, _) = time(&small);
            let (long, skipped) = time(&large);
            println!(
                "{} bytes in {long:?}, {} bytes in {short:?}",
                large.len(),
                small.len()
            );
            assert_eq!(
                (warm, skipped),
                (3_000, 30_000),
                "every material is counted"
            );
            // Ten times the text; a hundred times the time would be quadratic. The machine may be busy.
            assert!(long < 50 * short, "{long:?} against {short:?}");
        }
    }
}
