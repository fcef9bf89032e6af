//! The fields of a report. Their names and order are the JSON schema `kutzbach-report-1`: fields may be added, none may
//! change its meaning.
//!
//! Units: metres and radians. Dimensions, ranks and freedoms are plain counts. `null` means "not decided" or "does not
//! apply", as the field says; it never means zero. Every number is finite.

use super::change_sets::{ChangeSets, RedundantDirection};
use super::four_bar::FourBar;
use kutzbach_mobility::{
    CertificateLevel, MobilityClass, PoseKind, RelationKind, SingularKind, Verdict,
};
use serde::{Deserialize, Serialize};

/// The value of [`Report::schema`].
pub const SCHEMA: &str = "kutzbach-report-1";

/// Everything that is known of one mechanism at one pose.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Always [`SCHEMA`].
    pub schema: String,
    /// The mechanism's name.
    pub mechanism: String,
    /// Where it was read.
    pub source: Source,
    /// How large it is.
    pub size: Size,
    /// Kutzbach's count 6 (links − 1) − Σ (6 − freedom) − couplings (D2).
    pub kutzbach: i64,
    /// The count at random geometry of the same topology (D16); `null` where it was not made.
    pub generic: Option<GenericCount>,
    /// Whether and how the loops close (D17).
    pub assembly: Assembly,
    /// What holds at the pose.
    pub home: Home,
    /// The verdict.
    pub mobility: Mobility,
    /// Its finite mobility in useful and idle freedoms; `null` while it or its branches are not known.
    #[serde(default)]
    pub freedoms: Option<Freedoms>,
    /// What its inputs do (D26); `null` where nothing moves, or no branch is known.
    #[serde(default)]
    pub inputs: Option<Inputs>,
    /// Branches through the pose (D8): empty for an isolated assembly, `null` while not decided.
    pub branches: Option<Vec<Branch>>,
    /// One row per joint, loops included, in natural order of names.
    pub joints: Vec<JointRow>,
    /// Four-bar linkages on the ground that are a part of their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub four_bars: Vec<FourBar>,
    /// One row per coupling, in natural order of names.
    pub couplings: Vec<CouplingRow>,
    /// The basic cycles of the spanning tree (D14).
    pub cycles: Vec<Cycle>,
    /// The spanning tree the cycles come from (D15); `null` where it was not made.
    pub tree: Option<Tree>,
    /// How links move relative to one another (D19): every link seen from the ground, after the pairs that were asked for.
    pub motions: Vec<Motion>,
    /// Single joints whose relaxation removes redundancy without adding freedom.
    pub advice: Vec<Advice>,
    /// Sets of joints whose relaxation, all at once, leaves no constraint redundant and the finite mobility as it is; `null` where
    /// nothing is redundant or the counts are not decided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub change_sets: Option<ChangeSets>,
    /// The play that joints need for the motion to go through with the numbers as written; only where asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub play: Option<super::play::Play>,
    /// What a careful reader should know: oddities of the file, short margins.
    pub warnings: Vec<String>,
    /// What of the file was not read, because it says nothing about motion.
    pub skipped: Vec<String>,
    /// What every engine found; only where asked for, since its figures differ from machine to machine in their last
    /// digits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evidence: Option<Vec<Evidence>>,
    /// How long the stages took; only where asked for, so that reports can be compared byte by byte.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timing: Option<Timing>,
}

/// Where a mechanism was read, and how precisely its geometry is stated.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// The file as named by the caller.
    pub file: String,
    /// Its format, such as `urdf`.
    pub format: String,
    /// The most decimals of any literal in the geometry; `null` where there is no literal to round.
    pub digits: Option<i32>,
    /// Whether every number is taken as exact (D13).
    pub exact: bool,
    /// How well the literals were said to be known (m, rad), where that was said by hand instead of by digits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub precision: Option<f64>,
    /// Literals that were read as the constants they are within their own digits, where there are such.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub constants: Option<Constants>,
}

/// Literals that were read as constants, such as `1.5707963267948966` as π/2.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Constants {
    /// How many.
    pub count: usize,
    /// Each constant once, with the first literal that was read so.
    pub readings: Vec<LiteralReading>,
}

/// A literal and what it was read as.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LiteralReading {
    /// The text in the file.
    pub literal: String,
    /// The constant, such as `π/2`.
    pub read_as: String,
}

/// How large a mechanism is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Size {
    /// Links, the ground included.
    pub links: usize,
    /// Joints, those that close loops included.
    pub joints: usize,
    /// Independent loops: joints − links + connected parts.
    pub loops: usize,
    /// Couplings, `mimic` included.
    pub couplings: usize,
    /// Sum of the joint freedoms.
    pub freedoms: usize,
}

/// What remains of the count when the geometry is arbitrary.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct GenericCount {
    /// Freedoms at random geometry.
    pub mobility: usize,
    /// Dependent equations at random geometry.
    pub redundant: i64,
}

/// How the loops close.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Assembly {
    /// Whether all loops close within [`tolerance`](Self::tolerance); `null` where it was not tried.
    pub closed: Option<bool>,
    /// The largest gap left, as a length: angles count by the mechanism's characteristic length. Metres.
    pub residual: Option<f64>,
    /// How far the pose had to move from the file's to close; the largest shift of a joint, in metres.
    pub moved: Option<f64>,
    /// What the residual is held against: rounding and the numbers' stated precision, or what was given.
    pub tolerance: Option<f64>,
    /// Whether [`tolerance`](Self::tolerance) is the one asked for, instead of what the numbers' precision allows.
    #[serde(default)]
    pub tolerance_asked: bool,
    /// The gap of each loop of the file.
    pub gaps: Vec<Gap>,
    /// The most poses that any part was closed from: 1 where the drawn one sufficed; `null` where it was not tried.
    #[serde(default)]
    pub starts: Option<usize>,
    /// Whether the search for other starts ended at its limit on work, before all were tried.
    #[serde(default)]
    pub work_limited: bool,
    /// Joints that the configuration names and that keep its values, in natural order.
    #[serde(default)]
    pub held: Vec<String>,
    /// Joints whose values in the configuration are rounded, and were corrected to close the loops.
    #[serde(default)]
    pub corrected: Vec<String>,
    /// Where every joint with a freedom stands, in natural order of names.
    #[serde(default)]
    pub joints: Vec<JointPlace>,
    /// Joints outside their limits there, farthest first.
    #[serde(default)]
    pub outside_limits: Vec<OutsideLimit>,
    /// Whether it is proven that the loops close at no pose; `false` says nothing. Not of a pose with held joints: what is
    /// [`proof`](Self::proof) then holds as long as they are.
    #[serde(default)]
    pub proven_open: bool,
    /// Why the loops close at no pose, or at none with the held joints as they are, in one clause.
    #[serde(default)]
    pub proof: Option<String>,
    /// Where the loops do not close with the held joints as they are, but do once these are released: where that takes them.
    #[serde(default)]
    pub released: Option<Vec<JointPlace>>,
    /// A loop with which everything closes once one of its frames is turned over.
    #[serde(default)]
    pub reversal: Option<Reversal>,
    /// Whether dimensions were changed too, to those that rounded numbers mean.
    #[serde(default)]
    pub dimensions_changed: bool,
}

/// Where assembly took a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointPlace {
    /// Its name.
    pub name: String,
    /// Its values there (rad, m; the turn of a ball as a rotation vector), as a configuration holds them.
    pub values: Vec<f64>,
    /// Its values as drawn.
    pub drawn: Vec<f64>,
    /// The larger of [`turned`](Self::turned) and [`shifted`](Self::shifted), taken as numbers.
    pub correction: f64,
    /// Largest turn of its variables from the drawn pose (rad).
    pub turned: f64,
    /// Largest translation of its variables from there (m).
    pub shifted: f64,
}

/// A joint outside its limits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OutsideLimit {
    /// Its name.
    pub joint: String,
    /// By how much (rad, m); negative below the lower limit.
    pub by: f64,
    /// Whether that is an angle.
    pub angle: bool,
}

/// A frame that is to be turned over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reversal {
    /// The loop.
    #[serde(rename = "loop")]
    pub cycle: String,
    /// The direction about which the frame on its successor's side is to be turned by 180°, in that frame.
    pub about: [f64; 3],
}

/// The gap of one loop.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gap {
    /// The cycle's name.
    #[serde(rename = "loop")]
    pub cycle: String,
    /// Distance between the joint's two sides as the file draws them, in metres; what the joint allows is taken out.
    pub position: f64,
    /// Angle between them, in radians.
    pub angle: f64,
    /// What is left of the distance after assembly, in metres.
    pub left_position: f64,
    /// What is left of the angle after assembly, in radians.
    pub left_angle: f64,
}

/// What holds at the pose that was analysed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Home {
    /// Name of the configuration, `home` for all joint variables zero.
    pub configuration: String,
    /// Regular or singular (D6); `null` while not decided.
    pub pose: Option<PoseKind>,
    /// The kind of singularity (D7); `null` at regular poses and while not decided.
    pub kind: Option<SingularKind>,
    /// Instantaneous freedom (D3); `null` where the margin did not suffice or the mechanism does not assemble.
    pub instantaneous: Option<usize>,
    /// Smallest and largest instantaneous freedom that the margins leave possible.
    pub candidates: [usize; 2],
    /// The instantaneous freedom of the numbers taken literally, where it differs from that within stated precision.
    pub as_written: Option<usize>,
    /// Dependent constraint equations (D5): instantaneous − Kutzbach.
    pub redundant: Option<i64>,
    /// Rank of the constraint equations.
    pub rank: Option<usize>,
    /// Constraint equations: six per independent loop, one per coupling.
    pub equations: usize,
    /// Joint variables, and six more for each part that no joint connects with the ground.
    pub unknowns: usize,
    /// Smallest singular value kept over largest one dropped; `null` where none was dropped or dropped ones are zero.
    pub gap: Option<f64>,
    /// Smallest singular value kept, relative to the largest.
    pub kept: Option<f64>,
    /// Largest singular value dropped, relative to the largest.
    pub dropped: Option<f64>,
    /// The relative size below which a singular value counts as zero.
    pub tolerance: Option<f64>,
    /// How precisely the entries of the equations are known, relative to the largest.
    pub accuracy: Option<f64>,
    /// How the rank was found, in a few words; empty where it was not.
    pub method: String,
    /// Bits of the arithmetic that decided; 53 is double precision.
    pub bits: Option<u32>,
    /// The biconnected blocks, each with its own rank.
    pub blocks: Vec<Block>,
    /// The block whose rank has the least margin, by its label: `kept`, `dropped`, `gap`, `tolerance` and `accuracy` are
    /// its; `null` where there is but one block.
    #[serde(default)]
    pub weakest: Option<String>,
    /// A sentence on the margin, where it matters.
    pub note: Option<String>,
}

/// One biconnected block of the constraint graph: what can be analysed apart.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Block {
    /// A name made of one of its joints.
    pub name: String,
    /// What reasons call it: the words that the names of its joints have in common, or else `name`.
    #[serde(default)]
    pub label: String,
    /// Number of joints.
    pub joints: usize,
    /// Number of joint variables.
    pub unknowns: usize,
    /// Rank of the block's equations; `null` where undecided.
    pub rank: Option<usize>,
    /// Its share of the instantaneous freedom; `null` where undecided.
    pub instantaneous: Option<usize>,
    /// Its share of the finite freedom; `null` where undecided.
    #[serde(default)]
    pub finite: Option<usize>,
    /// Whether the pose is regular or singular for it; `null` while not decided.
    #[serde(default)]
    pub pose: Option<PoseKind>,
    /// In which way singular.
    #[serde(default)]
    pub kind: Option<SingularKind>,
    /// Hervé's class of its motion, where it moves.
    #[serde(default)]
    pub class: Option<MobilityClass>,
}

/// The verdict on finite mobility.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mobility {
    /// The answer in one word.
    pub verdict: Verdict,
    /// Finite mobility (D4); `null` while not decided.
    pub finite: Option<usize>,
    /// Proven bounds on it; `null` for a side without one.
    pub bounds: [Option<usize>; 2],
    /// Dimension over the complex numbers, where it was found.
    pub complex_dimension: Option<usize>,
    /// Hervé's class (D11).
    pub class: Option<MobilityClass>,
    /// What the answer rests on (D12); `null` while there is none.
    pub certificate: Option<Certificate>,
    /// A mobile mechanism within the stated precision of a rigid file (D13).
    pub nominal: Option<Nominal>,
    /// What the numbers taken literally leave, where the mechanism meant was computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub as_written: Option<AsWritten>,
    /// The reasons, one sentence each, weightiest first.
    pub why: Vec<String>,
}

/// The finite mobility taken apart, on the branches of the largest dimension.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Freedoms {
    /// The others than those below.
    pub useful: usize,
    /// Six for each piece that no joint connects with the ground, such as the base of a robot under a `floating` joint.
    #[serde(default)]
    pub floating: usize,
    /// Idle freedoms (D10).
    pub idle: usize,
    /// Whether all idle freedoms are rods, or legs between two balls, that spin about their own line.
    pub rods: bool,
    /// The ground, where the file holds it by convention only: the root link, and a body with a mass. Six freedoms more if it
    /// floats.
    pub base: Option<String>,
}

/// What the inputs of a mechanism do, along the first branch (D26).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Inputs {
    /// The inputs: joints, or single freedoms such as `slider.trans`.
    pub given: Vec<String>,
    /// Who names them; `null` where nobody does.
    pub source: Option<InputSource>,
    /// How many of them are independent; `null` where a margin does not tell.
    pub independent: Option<usize>,
    /// How many are independent at the pose itself, fewer at a dead centre; `null` where that is not known.
    pub independent_here: Option<usize>,
    /// Those that follow from others before them.
    pub dependent: Vec<DependentInput>,
    /// Freedoms that are left when the inputs are held, idle ones not counted; `null` where a margin does not tell.
    pub left: Option<usize>,
    /// Further inputs that would take them, none of which could be left out.
    pub proposed: Vec<String>,
    /// How many of the independent inputs and those proposed are independent together at the pose itself; `null` where that is
    /// not known.
    #[serde(default)]
    pub together_here: Option<usize>,
    /// Whether nothing is left with these.
    pub complete: bool,
    /// What follows from the inputs, given and proposed, in natural order of names.
    pub followers: Vec<Follower>,
    /// The link that the limbs hang on; `null` where there are no two limbs.
    pub base: Option<String>,
    /// Freedoms between the ground and that link.
    pub trunk: Option<usize>,
    /// The freedoms of each limb.
    pub limbs: Vec<Limb>,
}

/// Who names the inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum InputSource {
    /// The caller.
    Asked,
    /// The file, by its motors.
    File,
    /// The file, by its marks of independent coordinates.
    Independent,
}

/// An input that others determine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct DependentInput {
    /// The input.
    pub input: String,
    /// Those it follows from; empty where it cannot move; `null` where a margin does not tell which.
    pub on: Option<Vec<String>>,
}

/// A freedom that follows from inputs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Follower {
    /// The joint, or its single freedom.
    pub joint: String,
    /// The inputs that its rate depends on, empty where it rests; `null` where idle motion moves it too, or a margin does not tell.
    pub of: Option<Vec<String>>,
}

/// What hangs on the base by itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Limb {
    /// The link at its end; that at its start where it branches.
    pub end: String,
    /// Whether it branches, as a torso with two arms does.
    #[serde(default)]
    pub branches: bool,
    /// Its finite freedoms, idle ones included.
    pub freedom: usize,
    /// Its idle freedoms.
    pub idle: usize,
}

/// What an answer rests on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Certificate {
    /// How strong it is.
    pub level: CertificateLevel,
    /// What it proves, in one sentence.
    pub text: String,
}

/// A mechanism close to the one in the file that moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Nominal {
    /// Its finite mobility.
    pub finite: usize,
    /// How far the file's numbers, taken literally, are from closing along its motion, in metres.
    pub tolerance: f64,
    /// How far its geometry is from the file's (m; angles by the length of the loops); `null` where it was not computed.
    #[serde(default)]
    pub distance: Option<f64>,
    /// The tolerance asked for that stood in for the precision of the digits (m, rad), where these left the mobility open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub known_to: Option<f64>,
    /// Whether it lies within what the file's digits, or [`known_to`](Self::known_to), leave open.
    #[serde(default = "yes")]
    pub within_digits: bool,
    /// The numbers that it has otherwise, those that change most first; empty where it was not computed.
    #[serde(default)]
    pub changes: Vec<Change>,
    /// Relations that the file's numbers nearly satisfy and that it satisfies exactly, by which it was found.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub relations: Vec<Relation>,
}

/// A relation between axes or points of links.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Relation {
    /// What is exact.
    pub kind: RelationKind,
    /// The joints whose axes or points are related: two of one link, or two of each of two links.
    pub joints: Vec<String>,
    /// The angle between them in degrees, where it is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub degrees: Option<f64>,
}

fn yes() -> bool {
    true
}

/// A number of the file that the mechanism meant has otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// The joint.
    pub joint: String,
    /// Which number: `origin xyz[0]`, `successor rpy[2]`, `axis[1]`, `lead`, `distance`.
    pub number: String,
    /// As written (m, rad).
    pub from: f64,
    /// As meant (m, rad).
    pub to: f64,
}

/// What the file's numbers leave where they are taken literally.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AsWritten {
    /// The verdict.
    pub verdict: Verdict,
    /// Finite mobility; `null` where it is not decided.
    pub finite: Option<usize>,
}

/// What one engine found of one block (D20).
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Evidence {
    /// The block, by the name it has in [`Home::blocks`].
    pub block: String,
    /// The engine.
    pub engine: String,
    /// Where what it found holds: at the pose, in a neighbourhood, at every pose.
    pub scope: String,
    /// Bounds on the finite mobility of the block; `null` where it gives none from above.
    pub bounds: [Option<usize>; 2],
    /// Its figures: margins, orders, radii, seeds.
    pub text: String,
}

/// A branch of the configuration space through the pose, described at a generic pose of its own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Branch {
    /// Its name in this report.
    pub name: String,
    /// Its dimension: the freedoms a mechanism has while on it.
    pub dimension: usize,
    /// Instantaneous freedom at a generic pose of it; `null` where the margin does not tell.
    pub instantaneous: Option<usize>,
    /// Redundant equations there.
    pub redundant: Option<i64>,
    /// In how many directions it leaves the pose, for branches of dimension one.
    pub half_branches: Option<usize>,
    /// Joints that move nowhere on it (D9).
    pub locked: Vec<String>,
    /// Idle freedoms on it (D10).
    pub idle: Vec<Idle>,
    /// Freedoms that move these links a thousand times as much as all others: nearly idle, and counted as useful.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub nearly_idle: Vec<Idle>,
}

/// Links that can move while every other link stays.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Idle {
    /// The links that move together, the one that gives its name first.
    pub links: Vec<String>,
    /// In how many ways.
    pub freedom: usize,
    /// Whether they hang between balls: a rod or a leg that spins about its own line.
    #[serde(default, skip_serializing_if = "is_false")]
    pub rod: bool,
}

/// One joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointRow {
    /// Its name.
    pub name: String,
    /// Its class in short, such as `R`.
    pub class: String,
    /// Its kind in words, such as `revolute`.
    pub kind: String,
    /// The links it connects, predecessor first.
    pub links: [String; 2],
    /// Its freedoms.
    pub freedom: usize,
    /// Whether none of its freedoms moves (D9) on any branch; at the pose where no branch is known.
    pub locked: Option<bool>,
    /// The single freedoms that do not move, such as `slider.rot`.
    pub locked_parts: Vec<String>,
    /// Directions in which its reaction is statically undetermined.
    pub redundant_wrenches: Option<usize>,
    /// The directions of these.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub redundant_directions: Vec<RedundantDirection>,
    /// Whether the file writes it as the closure of a loop.
    pub closes_loop: bool,
    /// The label of its block ([`Block::label`]); `null` where it is in no loop and no coupling, and moves by itself.
    #[serde(default)]
    pub block: Option<String>,
    /// How far it goes on each branch that is a curve, one entry for each of its freedoms that moves; empty where that was not
    /// followed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ranges: Vec<JointRange>,
}

/// How far a joint goes along a branch that is a curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointRange {
    /// The branch.
    pub branch: String,
    /// Which of its freedoms, such as `trans`; `null` for a joint of one.
    pub part: Option<String>,
    /// Least value (rad, m), counted through full turns.
    pub min: f64,
    /// Greatest value.
    pub max: f64,
    /// Full turns in one cycle; zero where it swings.
    pub turns: i64,
    /// Whether it is an angle.
    pub angle: bool,
    /// Whether the motion goes on beyond what was followed.
    #[serde(default, skip_serializing_if = "is_false")]
    pub at_least: bool,
}

/// One coupling.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CouplingRow {
    /// Its name.
    pub name: String,
    /// Its equation.
    pub text: String,
}

/// One basic cycle.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cycle {
    /// Its name in this report: `C1`, `C2`, …
    pub name: String,
    /// Its joints in order.
    pub joints: Vec<String>,
    /// The subgroup its displacements generate, in short (such as `G`); `null` where that is all of SE(3).
    pub space: Option<String>,
    /// The same in words, with its axis, plane or point; empty where not found.
    pub space_text: String,
    /// The subgroup's dimension; `null` where not found.
    pub dimension: Option<usize>,
    /// Rank of its six equations when taken alone; `null` where not decided.
    pub rank: Option<usize>,
    /// Its dependent equations when taken alone.
    pub redundant: Option<i64>,
    /// Its instantaneous freedom when taken alone.
    pub mobility: Option<usize>,
    /// Joints that this cycle locks by itself.
    pub locks: Vec<String>,
}

/// The spanning tree: that of the file, rooted at the ground (D15). The joints that are not in it close the loops; they are
/// those with [`JointRow::closes_loop`], unless a link is held by such joints alone.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tree {
    /// The root link.
    pub root: String,
    /// The most joints between the root and any link.
    pub depth: usize,
    /// How each other link hangs on the tree.
    pub links: Vec<TreeLink>,
}

/// How one link hangs on the spanning tree.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TreeLink {
    /// The link.
    pub link: String,
    /// The link next to it on the way to the root.
    pub parent: String,
    /// The joint between the two.
    pub joint: String,
    /// Joints between it and the root.
    pub depth: usize,
}

/// How one link moves relative to another along a branch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// The branch.
    pub branch: String,
    /// The link.
    pub link: String,
    /// The link it is seen from.
    pub relative_to: String,
    /// Its degrees of freedom: the dimension of the set of its relative displacements; `None` where that is not decided.
    pub freedom: Option<usize>,
    /// Hervé's letter, such as `R` or `T3`, where these displacements are a subgroup; otherwise how many of its degrees of
    /// freedom turn it and how many do not, such as `1R` or `1R 2T`; `?` where that is not decided.
    pub class: String,
    /// The same in words, with axes in the frame of `relative_to`.
    pub text: String,
    /// Hervé's letter of the smallest subgroup that is known to hold all its displacements.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub within: Option<String>,
    /// The joint whose motion this is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// How many of its degrees of freedom turn it, at a generic pose; `None` where that is not decided.
    pub rotations: Option<usize>,
    /// The others.
    pub translations: Option<usize>,
    /// Least and greatest pitch (m/rad) of the screws of a motion of one degree of freedom, at the generic poses of the branch that
    /// were looked at; zeros where it turns without sliding.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitches: Option<[f64; 2]>,
    /// Whether [`pitches`](Self::pitches) are the extremes of the whole branch, which was followed from end to end.
    #[serde(default, skip_serializing_if = "is_false")]
    pub whole_branch: bool,
    /// Whether this pair of links was asked for by name.
    #[serde(default, skip_serializing_if = "is_false")]
    pub asked: bool,
}

// By reference, as serde calls it.
#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_false(value: &bool) -> bool {
    !*value
}

/// A joint to relax.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Advice {
    /// The advice as a sentence.
    pub text: String,
    /// The joint.
    pub joint: String,
    /// Its class now.
    pub from: String,
    /// The class it should get; `none` where it may be removed.
    pub to: String,
    /// Redundant equations now.
    pub redundant_before: i64,
    /// Redundant equations afterwards.
    pub redundant_after: i64,
}

/// How long an analysis took.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// All of it, in milliseconds.
    pub total_ms: f64,
    /// Its stages, in the order they ran.
    pub stages: Vec<Stage>,
}

/// How long one stage took.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stage {
    /// The stage.
    pub name: String,
    /// Milliseconds.
    pub ms: f64,
}
