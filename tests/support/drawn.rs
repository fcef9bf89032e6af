//! Mechanisms drawn in a few lines: joints with their points and directions in world coordinates at home.
//!
//! Every link frame lies in the world's origin, every link is placed without constraint, and every joint is a loop: which
//! joints carry the tree is left to the analysis.

use kutzbach::mechanism::Mechanism;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// What is known of a drawn mechanism; `None` where nothing is stated.
pub struct Known {
    pub finite: usize,
    pub instantaneous: usize,
    pub kutzbach: i64,
    pub regular: bool,
    pub kind: Option<String>,
    pub branches: Option<usize>,
    /// Dimensions of the branches, largest first.
    pub dimensions: Option<Vec<usize>>,
}

pub struct Drawn {
    pub name: String,
    pub known: Known,
    lines: Vec<String>,
}

/// Reads blocks: a heading `= name finite instantaneous kutzbach kind branches dimensions : why`, then a line per joint.
pub fn read(text: &str) -> Vec<Drawn> {
    let mut drawn: Vec<Drawn> = Vec::new();
    for line in text.lines().map(str::trim) {
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        match line.strip_prefix("= ") {
            Some(heading) => drawn.push(heading_of(heading)),
            None => drawn.last_mut().unwrap().lines.push(line.to_owned()),
        }
    }
    drawn
}

fn heading_of(heading: &str) -> Drawn {
    let (facts, _why) = heading.split_once(':').unwrap();
    let facts: Vec<&str> = facts.split_whitespace().collect();
    let [
        name,
        finite,
        instantaneous,
        kutzbach,
        kind,
        branches,
        dimensions,
    ] = facts[..]
    else {
        panic!("{heading}")
    };
    let stated = |word: &str| (word != "-").then(|| word.to_owned());
    Drawn {
        name: name.to_owned(),
        known: Known {
            finite: finite.parse().unwrap(),
            instantaneous: instantaneous.parse().unwrap(),
            kutzbach: kutzbach.parse().unwrap(),
            regular: kind == "regular",
            kind: stated(kind).filter(|k| k != "regular"),
            branches: stated(branches).map(|n| n.parse().unwrap()),
            dimensions: stated(dimensions)
                .map(|list| list.split(',').map(|d| d.parse().unwrap()).collect()),
        },
        lines: Vec::new(),
    }
}

impl Drawn {
    /// The mechanism file.
    pub fn urdf(&self) -> String {
        let joints: Vec<Vec<String>> = self.lines.iter().map(|line| words(line)).collect();
        let links: BTreeSet<&str> = joints
            .iter()
            .flat_map(|j| [j[2].as_str(), j[3].as_str()])
            .collect();
        let mut text = format!("<robot name=\"{}\">\n<ground link=\"g\"/>\n", self.name);
        for link in &links {
            let _ = writeln!(text, "<link name=\"{link}\"/>");
        }
        for link in links.iter().filter(|link| **link != "g") {
            let _ = writeln!(
                text,
                "<joint name=\"place_{link}\" type=\"floating\"><parent link=\"g\"/><child link=\"{link}\"/></joint>"
            );
        }
        for joint in &joints {
            write_joint(&mut text, joint);
        }
        text.push_str("</robot>\n");
        text
    }

    pub fn mechanism(&self) -> Mechanism {
        kutzbach::format::read(&self.urdf(), &self.name, &[])
            .unwrap_or_else(|error| panic!("{error}"))
            .mechanism
    }
}

/// Splits at spaces outside `${…}`.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut inside = false;
    for letter in line.chars() {
        match letter {
            ' ' if !inside => words.push(String::new()),
            letter => {
                inside = (inside || letter == '{') && letter != '}';
                words.last_mut().unwrap().push(letter);
            }
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

fn write_joint(text: &mut String, joint: &[String]) {
    let [name, kind, predecessor, successor, x, y, z, rest @ ..] = joint else {
        panic!("{joint:?}")
    };
    let kind = match kind.as_str() {
        "R" => "revolute",
        "P" => "prismatic",
        "C" => "cylindrical",
        "H" => "screw",
        "S" => "spherical",
        "U" => "universal",
        "E" => "planar",
        "T2" => "planar_translation",
        "T" => "translational",
        "D" => "distance",
        "PP" => "point_on_plane",
        other => panic!("{other}"),
    };
    let point = format!("{x} {y} {z}");
    let far = if kind == "distance" {
        rest.join(" ")
    } else {
        point.clone()
    };
    let _ = writeln!(
        text,
        "<loop name=\"{name}\" type=\"{kind}\"><predecessor link=\"{predecessor}\"><origin xyz=\"{point}\"/></predecessor>\
         <successor link=\"{successor}\"><origin xyz=\"{far}\"/></successor>"
    );
    match (kind, rest.len()) {
        ("distance" | "spherical" | "translational", _) => {}
        ("point_on_plane", 3) => {
            let _ = writeln!(text, "<axis2 xyz=\"{}\"/>", rest.join(" "));
        }
        ("screw", 4) => {
            let _ = writeln!(text, "<axis xyz=\"{}\"/>", rest[..3].join(" "));
            let _ = writeln!(text, "<screw lead=\"{}\"/>", rest[3]);
        }
        (_, 3 | 6) => {
            let _ = writeln!(text, "<axis xyz=\"{}\"/>", rest[..3].join(" "));
            if let [_, _, _, second @ ..] = rest
                && second.len() == 3
            {
                let _ = writeln!(text, "<axis2 xyz=\"{}\"/>", second.join(" "));
            }
        }
        _ => panic!("{joint:?}"),
    }
    text.push_str("</loop>\n");
}
