//! Families of mechanisms of growing size, for the ways of computing a basis.

use std::fmt::Write;

/// A family: its name, what it is, its sizes, and the text of a member.
pub struct Family {
    pub name: &'static str,
    pub about: &'static str,
    pub sizes: &'static [usize],
    pub text: fn(usize) -> String,
}

pub const FAMILIES: &[Family] = &[
    Family {
        name: "stack of tables",
        about: "N Cartesian tables one on top of the other: the cycles of different tables share no joint",
        sizes: &[1, 2, 3, 4, 6, 8],
        text: stack_of_tables,
    },
    Family {
        name: "row of jaws",
        about: "N + 1 jaws on a frame, each in a slide and sliding in the next, as in the assembly of Thomas and Torras: \
                every cycle shares a joint with the next one, and fixes a turn",
        sizes: &[1, 2, 4, 8, 16, 32],
        text: row_of_jaws,
    },
    Family {
        name: "ladder of parallelograms",
        about: "N parallelogram loops side by side, each sharing a crank with the next: every loop has two modes",
        sizes: &[1, 2, 3, 4, 5, 6],
        text: ladder_of_parallelograms,
    },
    Family {
        name: "ladder of quadrilaterals",
        about: "N four-bar loops in general position, each sharing a crank with the next: nothing is fixed, nothing splits",
        sizes: &[1, 2, 3, 4],
        text: ladder_of_quadrilaterals,
    },
];

fn robot(name: &str, body: &str) -> String {
    format!("<robot name=\"{name}\">\n{body}</robot>\n")
}

fn links(names: impl IntoIterator<Item = String>) -> String {
    names.into_iter().fold(String::new(), |mut text, name| {
        // Writing to a string does not fail.
        let _ = writeln!(text, "  <link name=\"{name}\"/>");
        text
    })
}

fn joint(name: &str, class: &str, [parent, child]: [&str; 2], at: &str, axis: &str) -> String {
    format!(
        "  <joint name=\"{name}\" type=\"{class}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
         <origin xyz=\"{at}\"/><axis xyz=\"{axis}\"/></joint>\n"
    )
}

fn closing(
    name: &str,
    class: &str,
    [[predecessor, there], [successor, here]]: [[&str; 2]; 2],
    axes: &str,
) -> String {
    format!(
        "  <loop name=\"{name}\" type=\"{class}\"><predecessor link=\"{predecessor}\"><origin xyz=\"{there}\"/></predecessor>\
         <successor link=\"{successor}\"><origin xyz=\"{here}\"/></successor>{axes}</loop>\n"
    )
}

/// Ruiz (1994), section 6.3.2, N times.
fn stack_of_tables(n: usize) -> String {
    let mut body = links((0..=n).map(|k| format!("plate{k}")));
    let (x, y, z) = (
        r#"<axis xyz="1 0 0"/>"#,
        r#"<axis xyz="0 1 0"/>"#,
        r#"<axis xyz="0 0 1"/>"#,
    );
    let facing = |axis: &str, normal: &str| format!("{axis}<axis2 xyz=\"{normal}\"/>");
    for k in 0..n {
        let link = |name: &str| format!("{name}{k}");
        let (bed, top) = (format!("plate{k}"), format!("plate{}", k + 1));
        let (lower, cross, upper) = (link("lower"), link("cross"), link("upper"));
        body += &links([lower.clone(), cross.clone(), upper.clone()]);
        body += &joint(
            &link("plates"),
            "plane_on_plane",
            [&bed, &top],
            "0 0 0",
            "1 0 0",
        );
        body += &format!(
            "  <joint name=\"place{k}\" type=\"floating\"><parent link=\"{bed}\"/><child link=\"{lower}\"/></joint>\n"
        );
        body += &joint(
            &link("bar1_"),
            "line_on_line",
            [&lower, &cross],
            "0 1 2",
            "1 0 0",
        );
        body += &joint(
            &link("bar2_"),
            "line_on_line",
            [&cross, &upper],
            "0 0 0",
            "1 0 0",
        );
        body += &closing(
            &link("bar3_"),
            "line_on_line",
            [[&cross, "1 0 0"], [&lower, "1 1 2"]],
            z,
        );
        body += &closing(
            &link("bar4_"),
            "line_on_line",
            [[&cross, "-1 0 0"], [&upper, "-1 0 0"]],
            y,
        );
        let rows = [
            (
                "on1_",
                [[lower.as_str(), "0 1 2"], [&bed, "0 1 0"]],
                facing(x, "0 1 0"),
            ),
            (
                "on2_",
                [[&lower, "1 1 0"], [&bed, "0 1 0"]],
                facing(z, "0 1 0"),
            ),
            (
                "on3_",
                [[&upper, "0 0 0"], [&top, "0 0 2"]],
                facing(x, "0 0 1"),
            ),
            (
                "on4_",
                [[&upper, "-1 0 0"], [&top, "0 0 2"]],
                facing(y, "0 0 1"),
            ),
        ];
        for (name, ends, axes) in rows {
            body += &closing(&link(name), "line_on_plane", ends, &axes);
        }
    }
    robot("stack_of_tables", &body)
}

/// Jaws along x in slides of the frame at x = 4k, y = 1, z = 0; neighbours slide in one another along x at z = 1.
fn row_of_jaws(n: usize) -> String {
    let mut body = links(["frame".to_owned()]);
    body += &links((0..=n).map(|k| format!("jaw{k}")));
    for k in 0..=n {
        let jaw = format!("jaw{k}");
        let at = format!("{} 1 0", 4 * k);
        body += &joint(
            &format!("slide{k}"),
            "line_on_line",
            ["frame", &jaw],
            &at,
            "1 0 0",
        );
    }
    for k in 0..n {
        let (this, next) = (format!("jaw{k}"), format!("jaw{}", k + 1));
        let ends = [[this.as_str(), "2 0 1"], [&next, "-2 0 1"]];
        body += &closing(
            &format!("between{k}"),
            "line_on_line",
            ends,
            "<axis xyz=\"1 0 0\"/>",
        );
    }
    robot("row_of_jaws", &body)
}

/// Cranks of length 5 at 3k, drawn at (3, 4).
fn ladder_of_parallelograms(n: usize) -> String {
    ladder("ladder_of_parallelograms", n, |k| (3 * k, [3, 4]))
}

/// Cranks of two lengths at three distances.
fn ladder_of_quadrilaterals(n: usize) -> String {
    ladder("ladder_of_quadrilaterals", n, |k| {
        let ends = [[3, 4], [-2, 5], [1, 6]];
        (7 * k + k * k, ends[k % 3])
    })
}

/// Cranks with pivots on the x axis and given free ends, neighbours joined by couplers.
fn ladder(name: &str, n: usize, crank: impl Fn(usize) -> (usize, [i32; 2])) -> String {
    let mut body = links(["ground".to_owned()]);
    body += &links((0..=n).map(|k| format!("crank{k}")));
    body += &links((0..n).map(|k| format!("coupler{k}")));
    for k in 0..=n {
        let link = format!("crank{k}");
        let at = format!("{} 0 0", crank(k).0);
        body += &joint(
            &format!("pivot{k}"),
            "revolute",
            ["ground", &link],
            &at,
            "0 0 1",
        );
    }
    for k in 0..n {
        let (here, [x, y]) = crank(k);
        let (there, [x2, y2]) = crank(k + 1);
        let (this, next, coupler) = (
            format!("crank{k}"),
            format!("crank{}", k + 1),
            format!("coupler{k}"),
        );
        body += &joint(
            &format!("left{k}"),
            "revolute",
            [&this, &coupler],
            &format!("{x} {y} 0"),
            "0 0 1",
        );
        let way = [there as i32 - here as i32 + x2 - x, y2 - y];
        let ends = [
            [coupler.as_str(), &format!("{} {} 0", way[0], way[1])],
            [&next, &format!("{x2} {y2} 0")],
        ];
        body += &closing(
            &format!("right{k}"),
            "revolute",
            ends,
            "<axis xyz=\"0 0 1\"/>",
        );
    }
    robot(name, &body)
}
