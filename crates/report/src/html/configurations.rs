//! All configurations of a mechanism on one page: side by side, and each with the motion that leads through it.

use super::blocks::prose;
use super::data::{BranchData, MotionData, PageData};
use super::document::shell;
use super::drawing::{motion, packed, page_data, placed, roles};
use super::escape::{escaped, in_script};
use super::names::Names;
use super::stage::{Assets, Facts, Stage};
use crate::picture::sketch::Sketch;
use kutzbach_motion::Variable;

/// A configuration's picture has room for this many pixels.
const PICTURE: [f64; 2] = [320.0, 220.0];

/// One configuration.
#[derive(Clone, Debug)]
pub struct Shown<'a> {
    /// The mechanism with a configuration of these joint values, and its analysis there with no joint held.
    pub facts: Facts<'a>,
    /// What it is called.
    pub title: String,
    /// What is to be said of it, such as that it is the drawn one.
    pub note: String,
    /// Joints and where they are, with units.
    pub values: Vec<(String, String)>,
}

/// The page: what is known in sentences, pictures of all configurations, and a mechanism that moves through each of them. All have to
/// be of the same mechanism; the first is where the page begins.
///
/// # Errors
/// Where data have no JSON form, which would be a fault of this program.
pub fn configurations_page(
    title: &str,
    sentences: &[String],
    shown: &[Shown<'_>],
) -> Result<String, serde_json::Error> {
    let mut content = format!(
        "<main>\n<header id=\"verdict\">\n<h1>{}</h1>\n",
        escaped(title)
    );
    for sentence in sentences {
        content.push_str(&format!("<p>{}</p>\n", prose(sentence)));
    }
    content.push_str("</header>\n");
    let link_poses = Assets::Inside.link_poses() / shown.len().max(1);
    let stages: Vec<Stage> = shown
        .iter()
        .map(|one| Stage::new(&one.facts, link_poses))
        .collect();
    if let (Some(first), Some(stage)) = (shown.first(), stages.first()) {
        content.push_str("<section id=\"motion\"><h2>Motion</h2>\n<div id=\"stage\">");
        content.push_str(&super::document::still(
            first.facts.mechanism,
            stage,
            [960.0, 540.0],
        ));
        content.push_str("</div>\n<div id=\"controls\"></div>\n</section>\n");
    }
    content
        .push_str("<section id=\"configurations\"><h2>Configurations</h2>\n<ul class=\"cards\">\n");
    for (one, stage) in shown.iter().zip(&stages) {
        card(one, stage, &stages[0], &mut content);
    }
    content.push_str("</ul></section>\n</main>\n");
    if let (Some(first), Some(stage)) = (shown.first(), stages.first()) {
        let data = data(shown, &stages, first, stage);
        content.push_str("<script type=\"application/json\" id=\"page-data\">");
        content.push_str(&in_script(&serde_json::to_string(&data)?));
        content.push_str("</script>\n");
    }
    Ok(shell(title, &content, Assets::Inside))
}

/// A configuration's picture and what is to be read of it; seen as the first one is, or what differs would not be seen.
fn card(one: &Shown<'_>, stage: &Stage, base: &Stage, out: &mut String) {
    let mut sketch = Sketch::new(one.facts.mechanism, &stage.drawing, &stage.home, base.view);
    sketch.size = PICTURE;
    let (picture, title) = (sketch.fragment(), escaped(&one.title));
    out.push_str(&format!("<li>{picture}<h3>{title}</h3>"));
    if !one.note.is_empty() {
        out.push_str(&format!("<p>{}</p>", escaped(&one.note)));
    }
    if !one.values.is_empty() {
        out.push_str("<table><tbody>");
        for (joint, value) in &one.values {
            let (joint, value) = (escaped(joint), escaped(value));
            out.push_str(&format!("<tr><td>{joint}</td><td>{value}</td></tr>"));
        }
        out.push_str("</tbody></table>");
    }
    out.push_str("</li>\n");
}

/// What the script is told: configurations take the place of another page's branches.
fn data(shown: &[Shown<'_>], stages: &[Stage], first: &Shown<'_>, base: &Stage) -> PageData {
    let mechanism = first.facts.mechanism;
    let offsets = mechanism.variable_offsets();
    let column = |variable: &Variable| offsets[variable.joint] + variable.freedom;
    let names = Names::new(mechanism, first.facts.report);
    let mut data = page_data(&first.facts, base, &names);
    data.branches.clear();
    data.motions.clear();
    for (index, (one, stage)) in shown.iter().zip(stages).enumerate() {
        let begin = data.motions.len();
        for played in &stage.repertoire.played {
            let mut own = motion(mechanism, played, base, &column);
            own.branch = index;
            data.motions.push(own);
        }
        if stage.repertoire.played.is_empty() {
            data.motions.push(at_rest(mechanism, index, stage, base));
        }
        let still = stage.repertoire.still.iter().flatten().next();
        data.branches.push(BranchData {
            name: one.title.clone(),
            dimension: one.facts.analysis.mobility.finite().unwrap_or(0),
            motions: (begin..data.motions.len()).collect(),
            still: still.or(stage.repertoire.nothing.as_ref()).cloned(),
        });
    }
    data
}

/// A configuration in which nothing moves, as a motion that stays where it is.
fn at_rest(
    mechanism: &kutzbach_model::mechanism::Mechanism,
    branch: usize,
    stage: &Stage,
    base: &Stage,
) -> MotionData {
    let poses: Vec<f64> = placed(&stage.home, base).into_iter().flatten().collect();
    let states = &stage.geometry.states;
    let values = || states.iter().flat_map(|state| state.values.iter().copied());
    MotionData {
        branch,
        closed: false,
        samples: 2,
        arclengths: packed([0.0, 1.0].into_iter()),
        values: packed(values().chain(values())),
        poses: packed(poses.iter().chain(&poses).copied()),
        start: 0,
        drives: Vec::new(),
        held: Vec::new(),
        roles: roles(mechanism, &stage.roles),
        events: Vec::new(),
        length_unit: 1.0,
    }
}
