//! The play that joints need where dimensions as written bind: against closed formulas, and against a brute-force optimisation
//! that knows nothing of the library but the frames of the file.

use kutzbach::closure::{Arithmetic, Geometry, Rigid};
use kutzbach::format::{Reading, read};
use kutzbach::mechanism::{FreedomPart, Mechanism};
use kutzbach::report::text::{Layout, render};
use kutzbach::report::{Options, Play, PlayAsked, Report, analysed_report};
use nalgebra::{
    DMatrix, DVector, Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3,
};

/// Play is found to a hundredth, and to first order in a misfit of at most a hundredth.
const AGREES: f64 = 0.03;

fn reported(text: &str, precision: Option<f64>, asked: PlayAsked) -> (Reading, Report, String) {
    let mut reading = read(text, "play.urdf", &[]).unwrap_or_else(|e| panic!("{e}"));
    if let Some(precision) = precision {
        reading.mechanism = reading.mechanism.with_precision(precision);
    }
    let options = Options {
        play: Some(asked),
        ..Options::default()
    };
    let (report, _) = analysed_report(&reading, "play.urdf", &options).unwrap();
    let page = render(&report, Layout::default());
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    (reading, report, page)
}

fn play_of(text: &str, asked: PlayAsked) -> (Play, String) {
    let (_, report, page) = reported(text, None, asked);
    (report.play.unwrap_or_else(|| panic!("{page}")), page)
}

/// A door on three hinges, the middle one off by so much on the frame's and on the door's side.
fn door(frame: &str, leaf: &str) -> String {
    format!(
        r#"<robot name="door"><link name="frame"/><link name="leaf"/>
        <joint name="lower" type="revolute"><parent link="frame"/><child link="leaf"/><origin xyz="0 0 0.200"/><axis xyz="0 0 1"/></joint>
        <loop name="middle" type="revolute"><predecessor link="frame"><origin xyz="{frame} 1.000"/></predecessor>
        <successor link="leaf"><origin xyz="{leaf} 0.800"/></successor><axis xyz="0 0 1"/></loop>
        <loop name="upper" type="revolute"><predecessor link="frame"><origin xyz="0 0 1.800"/></predecessor>
        <successor link="leaf"><origin xyz="0 0 1.600"/></successor><axis xyz="0 0 1"/></loop></robot>"#
    )
}

#[test]
fn a_door_needs_half_of_what_its_hinges_are_apart() {
    let asked = PlayAsked {
        clearance: Some(1e-3),
        bearing: Some(0.04),
    };
    // Off on the frame alone: three points in a row, the middle one 1 mm beside, and a straight line is nowhere farther than half.
    let (play, page) = play_of(&door("0.001 0", "0 0"), asked);
    assert!((play.needed / 0.5e-3 - 1.0).abs() < AGREES, "{page}");
    assert!(play.at_least <= 0.5e-3 * (1.0 + 1e-9), "{play:?}");
    assert_eq!((play.passes, play.arm), (Some(true), 0.02));
    assert!(
        (play.forgiven.unwrap() - 2.0).abs() < 2.0 * AGREES,
        "{play:?}"
    );
    assert!(page.contains("A clearance of 1 mm suffices"), "{page}");
    // Off on both sides alike: it closes as drawn, and is worst half a turn away, where both add up.
    let (play, page) = play_of(&door("0.002 0.001", "0.002 0.001"), asked);
    let apart = 2.0 * 0.002f64.hypot(0.001);
    assert!((play.needed / (apart / 2.0) - 1.0).abs() < AGREES, "{page}");
    let turned = play.at.rem_euclid(std::f64::consts::TAU);
    assert!((turned - std::f64::consts::PI).abs() < 0.1, "{play:?}");
    assert_eq!(play.passes, Some(false));
    assert!(page.contains("does not suffice: it forgives"), "{page}");
}

#[test]
fn a_parallelogram_with_a_long_spare_bar_needs_a_quarter_of_the_excess() {
    // Three bars side by side, the middle one 1 % too long: half its excess is a line's distance from three points, and each bar
    // has two pins.
    let bar = |name: &str, x: &str, length: &str| {
        format!(
            r#"<joint name="{name}_low" type="revolute"><parent link="ground"/><child link="{name}"/><origin xyz="{x} 0 0"/><axis xyz="0 0 1"/></joint>
            <loop name="{name}_high" type="revolute"><predecessor link="{name}"><origin xyz="0 {length} 0"/></predecessor>
            <successor link="coupler"><origin xyz="{x} 0 0"/></successor><axis xyz="0 0 1"/></loop>"#
        )
    };
    let text = format!(
        r#"<robot name="spare"><link name="ground"/><link name="left"/><link name="middle"/><link name="right"/><link name="coupler"/>
        <joint name="left_low" type="revolute"><parent link="ground"/><child link="left"/><origin xyz="0 0 0"/><axis xyz="0 0 1"/></joint>
        <joint name="left_high" type="revolute"><parent link="left"/><child link="coupler"/><origin xyz="0 0.500 0"/><axis xyz="0 0 1"/></joint>
        {}{}</robot>"#,
        bar("middle", "0.400", "0.505"),
        bar("right", "0.800", "0.500")
    );
    let (play, page) = play_of(&text, PlayAsked::default());
    // Where the bars lie along the coupler, another linear relation holds; elsewhere it is a quarter of 5 mm.
    assert!((play.needed / 1.25e-3 - 1.0).abs() < AGREES, "{page}");
    let pins = play.joints.iter().filter(|joint| joint.shift > 1.2e-3);
    assert_eq!(pins.count(), 6, "{play:?}");
}

#[test]
fn what_moves_as_written_needs_none() {
    let exact = std::fs::read_to_string(crate::support::folder("mechanisms/bennett.urdf")).unwrap();
    let (play, page) = play_of(
        &exact,
        PlayAsked {
            clearance: Some(1e-4),
            bearing: None,
        },
    );
    assert!(play.needed < 1e-10, "{play:?}");
    assert!(
        page.contains("None is needed along the whole motion"),
        "{page}"
    );
    let rigid = r#"<robot name="rigid"><link name="a"/><link name="b"/><joint name="x" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
        <loop name="y" type="revolute"><predecessor link="a"><origin xyz="1 0 0"/></predecessor><successor link="b"><origin xyz="1 0 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#;
    let (_, report, page) = reported(rigid, None, PlayAsked::default());
    assert!(
        report.play.is_none() && page.contains("no play can be told"),
        "{page}"
    );
}

/// Bennett's linkage with links of 3 and 4 and twists of 3/5 and 4/5, in numbers of three decimals.
const BENNETT: &str = r#"<robot name="bennett"><link name="base"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
    <joint name="hinge_1" type="revolute"><parent link="base"/><child link="crank"/><origin xyz="0 0 0"/><axis xyz="0 0 1"/></joint>
    <joint name="hinge_2" type="revolute"><parent link="crank"/><child link="coupler"/><origin xyz="0 4 0"/><axis xyz="4 0 3"/></joint>
    <joint name="hinge_4" type="revolute"><parent link="base"/><child link="rocker"/><origin xyz="3 0 0"/><axis xyz="0 -3 4"/></joint>
    <loop name="hinge_3" type="revolute"><predecessor link="coupler"><origin xyz="-0.692 -2.769 0.923"/></predecessor>
    <successor link="rocker"><origin xyz="-3.692 1.231 0.923"/></successor><axis xyz="0.308 0.231 0.923"/></loop></robot>"#;

/// A Sarrus linkage as a drawing program exports it, with three decimals.
const SARRUS: &str = r#"<robot name="sarrus"><link name="base"/><link name="lower_1"/><link name="upper_1"/><link name="plate"/>
    <link name="lower_2"/><link name="upper_2"/>
    <joint name="base_1" type="revolute"><parent link="base"/><child link="lower_1"/><origin xyz="0.065 0.046 -0.022" rpy="-1.264 0.271 0.616"/><axis xyz="0 0 1"/></joint>
    <joint name="knee_1" type="revolute"><parent link="lower_1"/><child link="upper_1"/><origin xyz="0.098 -0.095 0"/><axis xyz="0 0 1"/></joint>
    <joint name="top_1" type="revolute"><parent link="upper_1"/><child link="plate"/><origin xyz="-0.098 -0.116 0"/><axis xyz="0 0 1"/></joint>
    <joint name="base_2" type="revolute"><parent link="base"/><child link="lower_2"/><origin xyz="-0.027 0.063 0.018" rpy="-1.254 -0.259 1.981"/><axis xyz="0 0 1"/></joint>
    <joint name="knee_2" type="revolute"><parent link="lower_2"/><child link="upper_2"/><origin xyz="0.099 -0.1 0"/><axis xyz="0 0 1"/></joint>
    <loop name="top_2" type="revolute"><predecessor link="upper_2"><origin xyz="-0.099 -0.111 0"/></predecessor>
    <successor link="plate"><origin xyz="-0.074 0 0.07" rpy="0 -1.449 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#;

#[test]
fn play_is_that_of_a_brute_force_optimisation() {
    for (text, bearing) in [
        (BENNETT, None),
        (BENNETT, Some(0.1)),
        (SARRUS, None),
        (SARRUS, Some(0.01)),
    ] {
        let asked = PlayAsked {
            clearance: None,
            bearing,
        };
        let (reading, report, page) = reported(text, None, asked);
        let play = report.play.unwrap_or_else(|| panic!("{page}"));
        let mut ring = Ring::of(&reading.mechanism, play.arm);
        let driven = play.variable.as_str();
        let found = ring.least_play(&reading.mechanism, driven, play.at);
        assert!(
            (play.needed / found - 1.0).abs() < AGREES,
            "{driven} at {}: {} beside {found}",
            play.at,
            play.needed
        );
        assert!(play.at_least <= found * (1.0 + AGREES), "{play:?} {found}");
    }
}

/// (joint, from the link's frame to the joint's, axis, from there to the next link's).
type Hinge = (usize, Isometry3<f64>, Vector3<f64>, Isometry3<f64>);

/// One loop of hinges about known axes, walked round with frames of the file.
struct Ring {
    hinges: Vec<Hinge>,
    angles: Vec<f64>,
    /// Shift and arm times tilt of each hinge, in its frame behind the turn.
    off: Vec<[f64; 6]>,
    arm: f64,
}

impl Ring {
    fn of(mechanism: &Mechanism, arm: f64) -> Self {
        let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
        let structure = kutzbach::closure::Structure::new(mechanism);
        let mut hinges = Vec::new();
        for &(joint, forward) in &structure.parts[0].cycles[0] {
            let [predecessor, successor] = &geometry.sides[joint];
            let axis = mechanism.joints()[joint]
                .axis
                .0
                .each_ref()
                .map(|x| x.value());
            let axis = Vector3::from(axis).normalize();
            hinges.push(match forward {
                true => (
                    joint,
                    isometry(predecessor),
                    axis,
                    isometry(successor).inverse(),
                ),
                false => (
                    joint,
                    isometry(successor),
                    -axis,
                    isometry(predecessor).inverse(),
                ),
            });
        }
        let count = hinges.len();
        assert!((0..count).all(|i| mechanism.joints()[hinges[i].0].kind.freedoms() == [FreedomPart::Rotation]));
        Self {
            hinges,
            angles: vec![0.0; count],
            off: vec![[0.0; 6]; count],
            arm,
        }
    }

    /// What is left after going round: rotation vector times the arm, and shift.
    fn closure(&self) -> DVector<f64> {
        let mut pose = Isometry3::identity();
        for (((_, before, axis, after), angle), off) in
            self.hinges.iter().zip(&self.angles).zip(&self.off)
        {
            let turn = UnitQuaternion::from_scaled_axis(axis * *angle);
            let tilt =
                UnitQuaternion::from_scaled_axis(Vector3::new(off[3], off[4], off[5]) / self.arm);
            let away = Isometry3::from_parts(Translation3::new(off[0], off[1], off[2]), tilt);
            pose = pose * before * turn * away * after;
        }
        let turn = pose.rotation.scaled_axis() * self.arm;
        let shift = pose.translation.vector;
        DVector::from_iterator(6, turn.iter().chain(shift.iter()).copied())
    }

    fn derivative(&mut self, change: &dyn Fn(&mut Self, f64)) -> DVector<f64> {
        let step = 1e-6;
        change(self, step);
        let there = self.closure();
        change(self, -2.0 * step);
        let back = self.closure();
        change(self, step);
        (there - back) / (2.0 * step)
    }

    /// The columns of all angles but one.
    fn angle_columns(&mut self, driven: usize) -> DMatrix<f64> {
        let others: Vec<usize> = (0..self.angles.len()).filter(|&i| i != driven).collect();
        let columns: Vec<DVector<f64>> = others
            .iter()
            .map(|&i| self.derivative(&|ring, step| ring.angles[i] += step))
            .collect();
        DMatrix::from_columns(&columns)
    }

    /// Brings the driven hinge to an angle, the others to where the loop misses least, and looks for the least play there.
    fn least_play(&mut self, mechanism: &Mechanism, driven: &str, at: f64) -> f64 {
        let driven = (0..self.hinges.len())
            .find(|&i| mechanism.joints()[self.hinges[i].0].name == driven)
            .unwrap();
        // Passed backward, a hinge about the opposite axis turns by the same angle the other way round.
        let steps = (at.abs() / 0.02).ceil().max(1.0);
        for step in 1..=steps as usize {
            self.angles[driven] = at * step as f64 / steps;
            for _ in 0..8 {
                self.settle(driven, &self.closure());
            }
        }
        let mut needed = 0.0;
        for _ in 0..6 {
            needed = self.improve(driven);
        }
        assert!(self.closure().norm() < 1e-9, "{}", self.closure());
        needed
    }

    fn settle(&mut self, driven: usize, open: &DVector<f64>) {
        let columns = self.angle_columns(driven);
        let step = columns.svd(true, true).solve(&-open, 1e-12).unwrap();
        let others = (0..self.angles.len()).filter(|&i| i != driven);
        for (i, step) in others.zip(step.iter()) {
            self.angles[i] += step;
        }
    }

    /// One step of sequential linear-quadratic programming on the largest deviation: directions across the freedoms, weights that grow
    /// with the deviations, thousands of rounds.
    fn improve(&mut self, driven: usize) -> f64 {
        let columns = self.angle_columns(driven);
        let left = left_kernel(&columns);
        let count = self.hinges.len();
        let mut blocks = Vec::with_capacity(count);
        let mut across = Vec::with_capacity(count);
        for i in 0..count {
            let directions = across_axis(&self.hinges[i].2);
            let moved: Vec<DVector<f64>> = (0..6)
                .map(|k| self.derivative(&|ring, step| ring.off[i][k] += step))
                .collect();
            blocks.push(&left * DMatrix::from_columns(&moved) * &directions);
            across.push(directions);
        }
        // The deviations there are have their share in what is open.
        let mut wanted = -(&left * self.closure());
        for ((block, directions), off) in blocks.iter().zip(&across).zip(&self.off) {
            let here = directions.transpose() * DVector::from_row_slice(off);
            wanted += block * here;
        }
        let mut weights = vec![1.0; count];
        let mut best = (f64::INFINITY, Vec::new());
        for _ in 0..4000 {
            let mut normal = DMatrix::zeros(wanted.len(), wanted.len());
            for (block, weight) in blocks.iter().zip(&weights) {
                normal += block * block.transpose() / *weight;
            }
            let y = normal.svd(true, true).solve(&wanted, 1e-14).unwrap();
            let all: Vec<DVector<f64>> = blocks
                .iter()
                .zip(&weights)
                .map(|(block, weight)| block.transpose() * &y / *weight)
                .collect();
            let most = all.iter().map(DVector::norm).fold(0.0, f64::max);
            for (weight, u) in weights.iter_mut().zip(&all) {
                *weight = (*weight * u.norm() / most).max(1e-9);
            }
            if most < best.0 {
                best = (most, all);
            }
        }
        for (i, u) in best.1.iter().enumerate() {
            let off = &across[i] * u;
            self.off[i] = std::array::from_fn(|k| off[k]);
        }
        for _ in 0..3 {
            self.settle(driven, &self.closure());
        }
        best.0
    }
}

/// Five directions of (shift, arm times tilt) that a hinge about an axis constrains.
fn across_axis(axis: &Vector3<f64>) -> DMatrix<f64> {
    let one = axis.cross(&Vector3::new(0.3, -0.5, 0.8)).normalize();
    let two = axis.cross(&one);
    let mut directions = DMatrix::zeros(6, 5);
    for i in 0..3 {
        directions[(i, i)] = 1.0;
    }
    for i in 0..3 {
        directions[(3 + i, 3)] = one[i];
        directions[(3 + i, 4)] = two[i];
    }
    directions
}

fn left_kernel(columns: &DMatrix<f64>) -> DMatrix<f64> {
    let (eigenvalues, eigenvectors) = {
        let eigen = (columns * columns.transpose()).symmetric_eigen();
        (eigen.eigenvalues, eigen.eigenvectors)
    };
    let most = eigenvalues.max();
    let rows: Vec<_> = (0..6)
        .filter(|&i| eigenvalues[i] < 1e-12 * most)
        .map(|i| eigenvectors.column(i).transpose())
        .collect();
    assert_eq!(rows.len(), 6 - columns.ncols());
    DMatrix::from_rows(&rows)
}

fn isometry(pose: &Rigid<f64>) -> Isometry3<f64> {
    let rotation = Matrix3::from_fn(|i, j| pose.rotation[i][j]);
    let rotation = Rotation3::from_matrix_unchecked(rotation);
    Isometry3::from_parts(
        Translation3::from(Vector3::from(pose.translation)),
        UnitQuaternion::from_rotation_matrix(&rotation),
    )
}
