//! Planar linkages whose plane is tilted at random, as other programs write them: poses as angles and quaternions, in the model, in one
//! another, in degrees, as points of a hinge. A reader multiplies these poses, and what their digits leave open has to come with them.

use kutzbach::format::{WriteOptions, read, write};
use kutzbach::matrix::SplitMix64;
use kutzbach::mobility::{AnalysisOptions, analyse};
use kutzbach::report::convert::{Hinges, in_full, to_mjcf, to_sdf};
use kutzbach::report::{ASSEMBLED, assembled_file};
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

/// How a program prints its numbers.
#[derive(Clone, Copy, Debug)]
enum Print {
    Decimals(usize),
    Single,
}

const PRINTS: [Print; 4] = [
    Print::Decimals(5),
    Print::Decimals(6),
    Print::Decimals(9),
    Print::Single,
];

impl Print {
    fn list(self, numbers: impl IntoIterator<Item = f64>) -> String {
        let text = |x: f64| match self {
            Self::Decimals(places) => format!("{x:.places$}"),
            Self::Single => format!("{:.9e}", x as f32),
        };
        let texts: Vec<String> = numbers.into_iter().map(text).collect();
        texts.join(" ")
    }

    fn vector(self, vector: Vector3<f64>) -> String {
        self.list(vector.iter().copied())
    }
}

/// A crank on the base, a coupler on the crank, and a third link on the base, which a hinge closes to the coupler:
///
/// ```text
///        B ---- coupler ---- C
///       /                     \
///    crank                    third link: a rocker, or a piston that slides
///     /                         \
///    A ========= base ========== D
/// ```
struct Drawn {
    /// Poses of the three links, in their joints A, B and D.
    links: [Isometry3<f64>; 3],
    /// The frame of the hinge that closes the loop.
    closing: Isometry3<f64>,
    /// Axes of the joints at A, B, D and C.
    axes: [Vector3<f64>; 4],
    slides: bool,
}

#[derive(Clone, Copy, Debug)]
struct Kind {
    /// Whether the third link is a piston.
    slides: bool,
    /// Whether the closing hinge is a degree off the plane's normal.
    spoiled: bool,
    /// The pitch of the frames is so near to a right angle (rad), where roll and yaw turn about nearly one axis; elsewhere anything.
    upright: Option<f64>,
}

fn turned_at_random(random: &mut SplitMix64) -> UnitQuaternion<f64> {
    let [roll, pitch, yaw] = [3.0, 1.2, 3.0].map(|most| most * random.symmetric());
    UnitQuaternion::from_euler_angles(roll, pitch, yaw)
}

/// The linkage in a plane that is tilted at random; frames of links lie in the plane, every other time anyhow.
fn drawn(seed: u64, kind: Kind) -> Drawn {
    let mut random = SplitMix64::new(seed);
    let tilt = turned_at_random(&mut random);
    let (a, b, c, d) = (
        Vector3::new(0.137, 0.211, 0.0),
        Vector3::new(0.437, 0.911, 0.05),
        Vector3::new(1.731, 1.243, 0.1),
        Vector3::new(1.837, -0.113, 0.15),
    );
    let normal = tilt * Vector3::z();
    let along = |from: Vector3<f64>, to: Vector3<f64>| {
        let way = to - from;
        tilt * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), way.y.atan2(way.x))
    };
    let mut placed = |at: Vector3<f64>, in_plane: UnitQuaternion<f64>| {
        let turn = match (seed % 2, kind.upright) {
            (_, Some(off)) => {
                let [roll, off, yaw] = [3.0, off, 3.0].map(|most| most * random.symmetric());
                UnitQuaternion::from_euler_angles(roll, std::f64::consts::FRAC_PI_2 - off, yaw)
            }
            (0, None) => in_plane,
            _ => turned_at_random(&mut random),
        };
        Isometry3::from_parts(Translation3::from(tilt * at), turn)
    };
    let third = match kind.slides {
        true => c,
        false => d,
    };
    let links = [
        placed(a, along(a, b)),
        placed(b, along(b, c)),
        placed(third, along(d, c)),
    ];
    let closing = placed(c, along(b, c));
    let off = match kind.spoiled {
        true => 1f64.to_radians(),
        false => 0.0,
    };
    let across = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), off);
    let of_third = match kind.slides {
        true => tilt * Vector3::new(0.28, -0.96, 0.0),
        false => normal,
    };
    let last = tilt * (across * Vector3::z());
    Drawn {
        links,
        closing,
        axes: [normal, normal, of_third, last],
        slides: kind.slides,
    }
}

impl Drawn {
    /// The closing hinge's frame in the third link.
    fn closing_in_third(&self) -> Isometry3<f64> {
        self.links[2].inverse() * self.closing
    }

    /// A link in what bears it.
    fn in_parent(&self, link: usize) -> Isometry3<f64> {
        match link {
            1 => self.links[0].inverse() * self.links[1],
            _ => self.links[link],
        }
    }

    fn axis_in_link(&self, link: usize) -> Vector3<f64> {
        self.links[link].rotation.inverse() * self.axes[link]
    }

    fn axis_of_closing(&self) -> Vector3<f64> {
        self.closing.rotation.inverse() * self.axes[3]
    }

    fn kind_of(&self, link: usize) -> &'static str {
        match link == 2 && self.slides {
            true => "prismatic",
            false => "revolute",
        }
    }
}

const LINKS: [&str; 3] = ["crank", "coupler", "third"];
const PARENTS: [&str; 3] = ["base", "crank", "base"];

fn rpy(pose: &Isometry3<f64>) -> [f64; 6] {
    let (roll, pitch, yaw) = pose.rotation.euler_angles();
    let t = pose.translation.vector;
    [t.x, t.y, t.z, roll, pitch, yaw]
}

fn sdf(drawn: &Drawn, print: Print, relative: bool, as_quaternion: bool) -> String {
    let pose = |pose: &Isometry3<f64>, within: &str| match as_quaternion {
        false => format!("<pose{within}>{}</pose>", print.list(rpy(pose))),
        true => {
            let (t, q) = (pose.translation.vector, pose.rotation.coords);
            let all = [t.x, t.y, t.z, q.x, q.y, q.z, q.w];
            let format = " rotation_format=\"quat_xyzw\"";
            format!("<pose{within}{format}>{}</pose>", print.list(all))
        }
    };
    let mut text = "<sdf version=\"1.9\"><model name=\"m\"><link name=\"base\"/>\n".to_owned();
    for (link, name) in LINKS.iter().enumerate() {
        let placed = match relative && link == 1 {
            true => pose(&drawn.in_parent(link), " relative_to=\"crank\""),
            false => pose(&drawn.links[link], ""),
        };
        let (parent, kind) = (PARENTS[link], drawn.kind_of(link));
        let axis = print.vector(drawn.axis_in_link(link));
        text += &format!(
            "<link name=\"{name}\">{placed}</link>\n<joint name=\"of_{name}\" type=\"{kind}\"><parent>{parent}</parent>\
             <child>{name}</child><axis><xyz>{axis}</xyz></axis></joint>\n"
        );
    }
    let placed = pose(&drawn.closing_in_third(), "");
    let axis = print.vector(drawn.axis_of_closing());
    text += &format!(
        "<joint name=\"last\" type=\"revolute\"><parent>coupler</parent><child>third</child>{placed}\
         <axis><xyz>{axis}</xyz></axis></joint></model></sdf>"
    );
    text
}

/// URDF whose last joint stands inside `<gazebo>`.
fn gazebo(drawn: &Drawn, print: Print) -> String {
    let mut text = "<robot name=\"m\"><link name=\"base\"/>\n".to_owned();
    for (link, name) in LINKS.iter().enumerate() {
        let (parent, kind) = (PARENTS[link], drawn.kind_of(link));
        let [x, y, z, roll, pitch, yaw] = rpy(&drawn.in_parent(link));
        let (xyz, turn) = (print.list([x, y, z]), print.list([roll, pitch, yaw]));
        let axis = print.vector(drawn.axis_in_link(link));
        text += &format!(
            "<link name=\"{name}\"/><joint name=\"of_{name}\" type=\"{kind}\"><parent link=\"{parent}\"/>\
             <child link=\"{name}\"/><origin xyz=\"{xyz}\" rpy=\"{turn}\"/><axis xyz=\"{axis}\"/></joint>\n"
        );
    }
    let placed = print.list(rpy(&drawn.closing_in_third()));
    let axis = print.vector(drawn.axis_of_closing());
    text += &format!(
        "<gazebo><joint name=\"last\" type=\"revolute\"><parent>coupler</parent><child>third</child>\
         <pose>{placed}</pose><axis><xyz>{axis}</xyz></axis></joint></gazebo></robot>"
    );
    text
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Turn {
    Quaternion,
    Degrees,
    Radians,
}

/// MJCF, whose last hinge is two points of it.
fn mjcf(drawn: &Drawn, print: Print, turn: Turn) -> String {
    let turned = |pose: &Isometry3<f64>| {
        if turn == Turn::Quaternion {
            let q = pose.rotation.coords;
            return format!("quat=\"{}\"", print.list([q.w, q.x, q.y, q.z]));
        }
        // Turns about x, y and z of the frame that turns along.
        let r = pose.rotation.to_rotation_matrix();
        let angles = [
            (-r[(1, 2)]).atan2(r[(2, 2)]),
            r[(0, 2)].clamp(-1.0, 1.0).asin(),
            (-r[(0, 1)]).atan2(r[(0, 0)]),
        ];
        let angles = match turn {
            Turn::Degrees => angles.map(f64::to_degrees),
            _ => angles,
        };
        format!("euler=\"{}\"", print.list(angles))
    };
    let body = |link: usize, inside: &str| {
        let (name, pose) = (LINKS[link], drawn.in_parent(link));
        let at = print.vector(pose.translation.vector);
        let turned = turned(&pose);
        let axis = print.vector(drawn.axis_in_link(link));
        let kind = match drawn.kind_of(link) {
            "prismatic" => "slide",
            _ => "hinge",
        };
        format!(
            "<body name=\"{name}\" pos=\"{at}\" {turned}><joint name=\"of_{name}\" type=\"{kind}\" axis=\"{axis}\"/>{inside}</body>"
        )
    };
    let coupler = drawn.links[1].inverse();
    let anchors = [0.0, 0.2].map(|along| {
        let point = drawn.closing.translation.vector + along * drawn.axes[3];
        let anchor = print.vector((coupler * nalgebra::Point3::from(point)).coords);
        format!("<connect body1=\"coupler\" body2=\"third\" anchor=\"{anchor}\"/>")
    });
    let unit = match turn {
        Turn::Degrees => "degree",
        _ => "radian",
    };
    format!(
        "<mujoco><compiler angle=\"{unit}\"/><worldbody>{}{}</worldbody><equality>{}</equality></mujoco>",
        body(0, &body(1, "")),
        body(2, ""),
        anchors.concat()
    )
}

fn finite(text: &str, file: &str) -> Option<usize> {
    let reading = read(text, file, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let options = AnalysisOptions::default();
    let analysis = analyse(&reading.mechanism, &options).unwrap();
    analysis.mobility.finite()
}

/// Ten planes, in every print: the linkage moves, and does not with one hinge a degree off.
#[track_caller]
fn assert_planar(file: &str, written: impl Fn(&Drawn, Print) -> String) {
    let mut wrong = Vec::new();
    let mut ask = |seed: u64, print: Print, kind: Kind| {
        let text = written(&drawn(seed, kind), print);
        let expected = Some(usize::from(!kind.spoiled));
        let found = finite(&text, file);
        if found != expected {
            wrong.push(format!("{seed} {print:?} {kind:?}: {found:?}\n{text}"));
        }
    };
    for print in PRINTS {
        for seed in 0..12 {
            // Ten four-bars and two slider-cranks; half of the spoiled ones are enough.
            let slides = seed >= 10;
            let kind = |spoiled| Kind {
                slides,
                spoiled,
                upright: None,
            };
            ask(seed, print, kind(false));
            if seed < 4 || slides {
                ask(seed, print, kind(true));
            }
        }
    }
    let count = wrong.len();
    assert!(wrong.is_empty(), "{count} wrong, first {}", wrong[0]);
}

#[test]
fn of_sdf_in_the_model() {
    assert_planar("tilted.sdf", |drawn, print| sdf(drawn, print, false, false));
}

#[test]
fn of_sdf_in_one_another() {
    assert_planar("tilted.sdf", |drawn, print| sdf(drawn, print, true, false));
}

#[test]
fn of_sdf_with_quaternions_in_the_model() {
    assert_planar("tilted.sdf", |drawn, print| sdf(drawn, print, false, true));
}

#[test]
fn of_sdf_with_quaternions_in_one_another() {
    assert_planar("tilted.sdf", |drawn, print| sdf(drawn, print, true, true));
}

#[test]
fn of_urdf_with_a_joint_inside_gazebo() {
    assert_planar("tilted.urdf", gazebo);
}

#[test]
fn of_mjcf_with_quaternions() {
    assert_planar("tilted.xml", |drawn, print| {
        mjcf(drawn, print, Turn::Quaternion)
    });
}

#[test]
fn of_mjcf_in_degrees() {
    assert_planar("tilted.xml", |drawn, print| {
        mjcf(drawn, print, Turn::Degrees)
    });
}

#[test]
fn of_mjcf_in_radians() {
    assert_planar("tilted.xml", |drawn, print| {
        mjcf(drawn, print, Turn::Radians)
    });
}

/// Where the pitch is nearly a right angle roll and yaw are known badly, each by itself, and the pose as well as elsewhere.
#[test]
fn of_frames_that_stand_nearly_upright() {
    type Writes = fn(&Drawn, Print) -> String;
    let sources: [(&str, Writes); 4] = [
        ("tilted.xml", |drawn, print| {
            mjcf(drawn, print, Turn::Quaternion)
        }),
        ("tilted.xml", |drawn, print| {
            mjcf(drawn, print, Turn::Radians)
        }),
        ("tilted.sdf", |drawn, print| sdf(drawn, print, false, false)),
        ("tilted.sdf", |drawn, print| sdf(drawn, print, true, true)),
    ];
    for (file, written) in sources {
        for off in [2e-2, 1e-3, 1e-6] {
            for (seed, decimals, spoiled) in [(1, 4, false), (2, 6, false), (3, 6, true)] {
                let kind = Kind {
                    slides: false,
                    spoiled,
                    upright: Some(off),
                };
                let text = written(&drawn(seed, kind), Print::Decimals(decimals));
                let expected = Some(usize::from(!spoiled));
                assert_eq!(finite(&text, file), expected, "{seed} {off:e}\n{text}");
            }
        }
    }
}

/// What was read from poses that are multiplied moves after it was written by `convert` and read again, and what is a degree off does not.
#[test]
fn converted_they_are_what_they_were() {
    type Writes = fn(&Drawn, Print) -> String;
    let sources: [(&str, Writes); 3] = [
        ("tilted.xml", |drawn, print| {
            mjcf(drawn, print, Turn::Quaternion)
        }),
        ("tilted.sdf", |drawn, print| sdf(drawn, print, true, false)),
        ("tilted.urdf", gazebo),
    ];
    let mut asked = 0;
    for (file, written) in sources {
        for (seed, print, spoiled) in [
            (1, Print::Decimals(5), false),
            (3, Print::Decimals(6), false),
            (1, Print::Decimals(6), true),
            (3, Print::Single, false),
        ] {
            let kind = Kind {
                slides: false,
                spoiled,
                upright: None,
            };
            let text = written(&drawn(seed, kind), print);
            let reading = read(&text, file, &[]).unwrap();
            let meant = in_full(&reading.mechanism, &AnalysisOptions::default());
            let is_told = meant.note.is_some();
            assert!(
                is_told || spoiled || matches!(print, Print::Single),
                "{file} {seed}"
            );
            let expected = Some(usize::from(!spoiled));
            let mechanism = &meant.mechanism;
            for (text, file) in [
                (to_mjcf(mechanism, Hinges::TwoPoints).text, "again.xml"),
                (to_sdf(mechanism).unwrap().text, "again.sdf"),
                (write(mechanism), "again.urdf"),
            ] {
                assert_eq!(finite(&text, file), expected, "{seed} {print:?}\n{text}");
                asked += 1;
            }
            let assembly = meant.assembly.as_ref().unwrap();
            let held = assembled_file(mechanism, assembly, &WriteOptions::default()).unwrap();
            let again = read(&held, "held.urdf", &[]).unwrap();
            let options = AnalysisOptions {
                configuration: Some(ASSEMBLED.to_owned()),
                ..AnalysisOptions::default()
            };
            let found = analyse(&again.mechanism, &options).unwrap();
            assert_eq!(found.mobility.finite(), expected, "{seed}\n{held}");
        }
    }
    assert_eq!(asked, 36);
}

/// Three equal cranks between two bars: no axis is rounded, and every place is an exact sum of numbers that are.
#[test]
fn of_sums_of_rounded_numbers() {
    for print in [Print::Decimals(6), Print::Decimals(9), Print::Single] {
        // One crank that leans by a little more is no parallel one.
        for (seed, leaning, expected) in [(1, 0.0, 1), (2, 0.0, 1), (3, 0.0, 1), (1, 0.02, 0)] {
            let mut random = SplitMix64::new(seed);
            let [along, crank] = [0, 1].map(|_| 3.0 * random.symmetric());
            let at = |t: f64, length: f64, angle: f64| {
                let x = 0.1 + t * along.cos() + length * angle.cos();
                let y = t * along.sin() + length * angle.sin() - 0.2;
                format!("{} 0 0 0", print.list([x, y, 0.0]))
            };
            let bar = at(0.0, 0.4, crank);
            let mut text = format!(
                "<sdf version=\"1.9\"><model name=\"m\"><link name=\"base\"/><link name=\"bar\"><pose>{bar}</pose></link>\n"
            );
            for (i, t) in [0.0, 0.713, 1.391].into_iter().enumerate() {
                let angle = if i == 2 { crank + leaning } else { crank };
                let (foot, tip) = (at(t, 0.0, crank), at(t, 0.4, angle));
                text += &format!(
                    "<link name=\"c{i}\"><pose>{foot}</pose></link>\
                     <joint name=\"a{i}\" type=\"revolute\"><parent>base</parent><child>c{i}</child><axis><xyz>0 0 1</xyz></axis></joint>\
                     <joint name=\"b{i}\" type=\"revolute\"><parent>c{i}</parent><child>bar</child>\
                     <pose relative_to=\"__model__\">{tip}</pose><axis><xyz>0 0 1</xyz></axis></joint>\n"
                );
            }
            text += "</model></sdf>";
            let found = finite(&text, "cranks.sdf");
            assert_eq!(found, Some(expected), "{seed} {print:?} {leaning}\n{text}");
        }
    }
}

/// What is chosen stays exact: the same plane tilted by right angles and written in few digits, proved as it was.
#[test]
fn exact_compositions_stay_exact() {
    let text = "<sdf version=\"1.9\"><model name=\"m\"><link name=\"base\"/>\
        <link name=\"a\"><pose>0 0 0 1.5707963267948966 0 0</pose></link>\
        <link name=\"b\"><pose relative_to=\"a\">0.5 0 0 0 0 1.5707963267948966</pose></link>\
        <link name=\"c\"><pose>1.25 0 0 1.5707963267948966 0 0</pose></link>\
        <joint name=\"i\" type=\"revolute\"><parent>base</parent><child>a</child><axis><xyz>0 0 1</xyz></axis></joint>\
        <joint name=\"j\" type=\"revolute\"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>\
        <joint name=\"k\" type=\"revolute\"><parent>base</parent><child>c</child><axis><xyz>0 0 1</xyz></axis></joint>\
        <joint name=\"l\" type=\"revolute\"><parent>b</parent><child>c</child><pose>0 0.75 0 0 0 0</pose><axis><xyz>0 0 1</xyz></axis></joint>\
        </model></sdf>";
    let mechanism = read(text, "exact.sdf", &[]).unwrap().mechanism;
    assert!(mechanism.precision().is_exact());
    assert_eq!(finite(text, "exact.sdf"), Some(1));
}
