//! `kutzbach map`: a four-bar over two of its lengths, coloured by what is known of it in closed form.

use crate::support::empty_folder;
use roxmltree::{Document, Node};
use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};

/// Ground 2, crank 1, coupler `bar`, rocker `side`.
const FOUR_BAR: &str = r#"<robot name="four_bar" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="ground"/> <link name="crank"/> <link name="coupler"/> <link name="rocker"/>
  <xacro:property name="bar" value="2"/>
  <xacro:property name="side" value="1"/>
  <joint name="A" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
  <joint name="B" type="revolute"><parent link="crank"/><child link="coupler"/><origin xyz="0 1 0"/><axis xyz="0 0 1"/></joint>
  <joint name="D" type="revolute"><parent link="ground"/><child link="rocker"/><origin xyz="2 0 0"/><axis xyz="0 0 1"/></joint>
  <loop name="C" type="revolute">
    <predecessor link="coupler"><origin xyz="${bar} 0 0"/></predecessor>
    <successor link="rocker"><origin xyz="0 ${side} 0"/></successor>
    <axis xyz="0 0 1"/>
  </loop>
</robot>
"#;

fn kutzbach(folder: &Path, arguments: &[&str]) -> Output {
    crate::support::program()
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = kutzbach(folder, arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// A folder with the mechanism and its sweep.
fn swept(test: &str, more: &[&str]) -> std::path::PathBuf {
    let folder = empty_folder(test);
    fs::write(folder.join("four_bar.urdf"), FOUR_BAR).unwrap();
    let over = [
        "sweep",
        "four_bar.urdf",
        "--over",
        "bar=1..5:5",
        "--over",
        "side=0.5..2:4",
    ];
    done(&folder, &[&over[..], more].concat());
    folder
}

/// What is told of the cells: the first line has their values, the second one their answer.
fn told<'a>(document: &'a Document<'a>) -> Vec<Vec<&'a str>> {
    let is_cell = |node: &Node<'_, '_>| {
        let class = node.attribute("class").unwrap_or_default();
        node.has_tag_name("path") && class.split(' ').any(|one| one == "cell")
    };
    let cells = document.descendants().filter(is_cell);
    cells
        .map(|node| {
            let title = node.first_element_child().unwrap();
            title.text().unwrap().lines().collect()
        })
        .collect()
}

/// A chain of four bars closes where none is longer than the others together; where one is as long as they are, it lies on a line and
/// is rigid, though singular.
fn known(values: &str) -> &'static str {
    let number = |name: &str| -> f64 {
        let (_, rest) = values.split_once(&format!("{name} = ")).unwrap();
        rest.split(',').next().unwrap().parse().unwrap()
    };
    let longest = number("bar") - (2.0 + 1.0 + number("side"));
    match longest {
        x if x > 0.0 => "unassembled",
        x if x < 0.0 => "mobile, 1 DOF",
        _ => "rigid, singular",
    }
}

#[test]
fn a_four_bar_moves_where_its_lengths_let_it_close() {
    let folder = swept("map_cells", &["-o", "out.csv"]);
    let svg = done(&folder, &["map", "out.csv", "-x", "bar", "-y", "side"]);
    let document = Document::parse(&svg).unwrap();
    let cells = told(&document);
    assert_eq!(cells.len(), 20);
    for cell in &cells {
        assert_eq!(cell[1], known(cell[0]), "{cell:?}");
    }
    // 4 = 3 + 1 and 5 = 3 + 2 are on the border itself.
    let singular = cells.iter().filter(|cell| cell[1] == "rigid, singular");
    assert_eq!(singular.count(), 2);
    assert!(svg.contains("class=\"border\"") && svg.contains("mobile, 1 DOF: 14"));
    // The axes the other way round, and the same to a file.
    done(&folder, &["map", "out.csv", "-x", "side", "-o", "map.svg"]);
    let turned = fs::read_to_string(folder.join("map.svg")).unwrap();
    assert!(turned.contains("how it moves over side and bar"));
}

#[test]
fn a_page_has_the_command_that_makes_each_report() {
    let folder = swept("map_page", &["--depth", "motions", "-o", "out.csv"]);
    done(&folder, &["map", "out.csv", "-o", "map.html"]);
    let page = fs::read_to_string(folder.join("map.html")).unwrap();
    assert!(page.starts_with("<!doctype html>"));
    let command = "kutzbach report four_bar.urdf --set bar=4 --set side=1";
    let row = format!("<code>{command}</code>");
    assert!(page.contains(&row), "{page}");
    let (_, id) = page
        .lines()
        .find(|line| line.contains(&row))
        .and_then(|line| line.split_once("id=\""))
        .unwrap();
    let id = id.split('"').next().unwrap();
    assert!(page.contains(&format!("<a href=\"#{id}\">")));
    let words: Vec<&str> = command.split(' ').skip(1).collect();
    let json = done(&folder, &[&words[..], &["--format", "json"]].concat());
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(report["mobility"]["verdict"], "rigid");
    assert_eq!(report["home"]["pose"], "singular");
}

#[test]
fn shares_and_margins_are_drawn() {
    let folder = swept("map_shares", &["--shard", "1/2", "-o", "one.csv"]);
    let over = ["--over", "bar=1..5:5", "--over", "side=0.5..2:4"];
    let second = ["--shard", "2/2", "-o", "two.csv"];
    done(
        &folder,
        &[&["sweep", "four_bar.urdf"][..], &over, &second].concat(),
    );
    let asked = ["--colour", "margin"];
    let both = done(
        &folder,
        &[&["map", "one.csv", "two.csv"][..], &asked].concat(),
    );
    let turned = done(
        &folder,
        &[&["map", "two.csv", "one.csv"][..], &asked].concat(),
    );
    assert_eq!(both, turned);
    let document = Document::parse(&both).unwrap();
    assert_eq!(told(&document).len(), 20);
    assert!(both.contains("The margin is how many times"));
    let half = done(&folder, &["map", "one.csv"]);
    assert!(half.contains("10 of 20 variants are there."));
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let folder = swept("map_refused", &["--format", "jsonl", "-o", "out.jsonl"]);
    fs::write(folder.join("other.csv"), "a,b\n1,2\n").unwrap();
    done(
        &folder,
        &[
            "sweep",
            "four_bar.urdf",
            "--over",
            "bar=1,2",
            "-o",
            "one.csv",
        ],
    );
    for (arguments, said) in [
        (&["out.jsonl"][..], "lines of JSON"),
        (&["other.csv"][..], "the names of its columns"),
        (&["none.csv"][..], "cannot read"),
        (&["one.csv"][..], "two measures"),
        (&["one.csv", "-x", "sid"][..], "no measure `sid`"),
        (&[][..], "FILE"),
    ] {
        let output = kutzbach(&folder, &[&["map"][..], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let stderr = text(&output.stderr);
        // Long lines are folded.
        let stderr = stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(stderr.contains(said), "{arguments:?}: {stderr}");
    }
}
