//! What a simulation said, as tables and as JSON.

use super::idle::Idle;
use kutzbach::accuracy::Choice;
use kutzbach::mechanism::Mechanism;
use kutzbach::record::Summary;
use kutzbach::report::accuracy::choice_text;
use kutzbach::report::simulated::data;
use kutzbach::report::text::words::{counted, degrees, metres, names, runs};
use kutzbach::report::text::{Cell, Column, Layout, Page, Table, Tint};
use kutzbach::simulate::verification::{
    BranchVerification, Finding, Outcome, Pushing, Verification,
};
use kutzbach::simulate::{CostRow, Integrator, SceneRun, Solver, Trajectory, TrajectoryError};
use serde_json::{Value, json};

/// Held joints, or runs of them, named on a first screen.
const HELD: usize = 6;

/// Tests left out that are named there.
const UNTESTED: usize = 8;

/// Everything that was simulated.
pub struct Simulated<'a> {
    pub mechanism: &'a Mechanism,
    /// How far its dimensions are from those written (m), where rounded numbers mean other ones.
    pub changed: Option<f64>,
    /// Which setting a wanted error called for.
    pub choice: Option<Choice>,
    pub verification: Verification,
    /// The scene, and how far its motion is off.
    pub scene: Option<(SceneRun, Trajectory)>,
    pub cost: Option<Vec<CostRow>>,
    /// Options given that have nothing to act on.
    pub idle: Vec<Idle>,
    pub log: Option<(String, Summary)>,
    /// Whether Ctrl-C ended it.
    pub stopped: bool,
}

impl Simulated<'_> {
    /// Whether an error was wanted that no setting, or not the scene, keeps.
    pub fn misses(&self) -> bool {
        let scene = self.scene.as_ref();
        let missed = scene.is_some_and(|(_, trajectory)| trajectory.reached == Some(false));
        missed || self.choice.as_ref().is_some_and(|choice| !choice.reached)
    }
}

fn tint(outcome: Outcome) -> Tint {
    match outcome {
        Outcome::Confirmed => Tint::Good,
        Outcome::Contradicted => Tint::Bad,
        Outcome::Inconclusive => Tint::Doubtful,
    }
}

fn sentence(finding: &Finding) -> String {
    let mut word = finding.outcome.word().to_owned();
    if let Some(first) = word.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    format!("{word}: {}.", finding.why)
}

/// Which dimensions the motion is of.
pub fn of_nearest(changed: f64) -> String {
    format!(
        "Simulated: the nearest dimensions that move, up to {} from those written.",
        metres(changed)
    )
}

/// A duration in seconds, to three digits.
fn seconds(time: f64) -> String {
    if time < 1e-3 {
        format!("{:.0} µs", time * 1e6)
    } else if time < 1.0 {
        format!("{:.1} ms", time * 1e3)
    } else {
        format!("{time:.2} s")
    }
}

/// Pages for a person.
pub fn text(simulated: &Simulated<'_>, layout: Layout) -> String {
    let mut page = Page::new(layout);
    let verification = &simulated.verification;
    page.paragraph(
        &sentence(&verification.finding),
        tint(verification.finding.outcome),
        "",
        "",
    );
    page.paragraph(
        &format!(
            "{}: predicted {}.",
            simulated.mechanism.name(),
            verification.verdict.word()
        ),
        Tint::Plain,
        "",
        "",
    );
    if let Some(changed) = simulated.changed {
        page.paragraph(&of_nearest(changed), Tint::Plain, "", "");
    }
    if let Some(choice) = &simulated.choice {
        choice_page(choice, &mut page);
    }
    for branch in &verification.branches {
        branch_page(branch, &mut page);
    }
    if let Some(pushing) = &verification.pushing {
        pushing_page(pushing, &mut page);
    }
    if let Some((run, trajectory)) = &simulated.scene {
        scene_page(run, &mut page);
        trajectory_page(run, trajectory, &mut page);
    }
    if let Some(rows) = &simulated.cost {
        cost_page(rows, &mut page);
    }
    if !verification.notes.is_empty() {
        page.heading("Assumptions of the simulation");
        let shown = if page.layout().verbose { usize::MAX } else { 3 };
        for note in verification.notes.iter().take(shown) {
            page.item(note, Tint::Quiet);
        }
        let left = verification.notes.len().saturating_sub(shown);
        if left > 0 {
            page.item(
                &format!(
                    "… and {}: `--verbose` shows them",
                    counted(left, "more note")
                ),
                Tint::Quiet,
            );
        }
    }
    for Idle { option, because } in &simulated.idle {
        let text = format!("`{option}` changes nothing: {because}");
        page.item(&text, Tint::Doubtful);
    }
    if let Some((path, summary)) = &simulated.log {
        page.gap();
        page.paragraph(
            &format!(
                "{path}: {} in {:.1} s{}",
                counted(summary.moments as usize, "moment"),
                summary.until,
                if simulated.stopped {
                    ", up to where it was interrupted"
                } else {
                    ""
                }
            ),
            Tint::Plain,
            "",
            "",
        );
    }
    page.into_text()
}

fn choice_page(choice: &Choice, page: &mut Page) {
    let tint = if choice.reached {
        Tint::Plain
    } else {
        Tint::Doubtful
    };
    let mut text = choice_text(choice);
    text.push_str(match (choice.reached, &choice.best) {
        (true, _) => " The verification begins with it.",
        (false, Some(_)) => " The verification begins with the best.",
        (false, None) => " The usual settings are used.",
    });
    page.paragraph(&text, tint, "", "");
}

fn branch_page(branch: &BranchVerification, page: &mut Page) {
    page.heading(&format!(
        "Branch {}, {}",
        branch.branch,
        degrees(branch.dimension)
    ));
    if branch.ladders.is_empty() {
        page.paragraph(
            &sentence(&branch.finding),
            tint(branch.finding.outcome),
            "  ",
            "  ",
        );
    }
    for ladder in &branch.ladders {
        let held = if ladder.held.is_empty() {
            String::new()
        } else {
            let named = match page.layout().verbose || ladder.held.len() <= HELD {
                true => ladder.held.join(", "),
                false => runs(&ladder.held, HELD),
            };
            format!(", {named} held")
        };
        page.paragraph(
            &format!(
                "{} driven from {:.4} to {:.4} ({}){held}; trees held by {}",
                ladder.driven,
                without_sign_of_zero(ladder.from),
                without_sign_of_zero(ladder.to),
                ladder.ends,
                match ladder.solver {
                    Solver::Multibody => "reduced coordinates (multibody)",
                    Solver::Impulse => "impulses",
                }
            ),
            Tint::Plain,
            "  ",
            "  ",
        );
        let mut table = Table::new()
            .column("substeps", Column::Numbers)
            .column("closure error", Column::Numbers)
            .column("order", Column::Numbers)
            .column("off the prediction", Column::Numbers)
            .column("travel reached", Column::Numbers)
            .column("wall time", Column::Numbers);
        for rung in &ladder.rungs {
            table.row(vec![
                Cell::new(rung.substeps.to_string()),
                Cell::new(format!("{:.1e}", rung.closure_error)),
                Cell::new(rung.order.map_or("–".to_owned(), |o| format!("{o:.1}"))),
                Cell::new(format!("{:.1e}", rung.distance)),
                Cell::new(format!("{:.0} %", 100.0 * rung.progress.min(1.0))),
                Cell::new(seconds(rung.wall_time)),
            ]);
        }
        page.table(table, "rungs");
        page.paragraph(
            &sentence(&ladder.finding),
            tint(ladder.finding.outcome),
            "  ",
            "  ",
        );
    }
    if !branch.untested.is_empty() {
        let most = match page.layout().verbose {
            true => branch.untested.len(),
            false => UNTESTED,
        };
        let text = format!("Not tested: {}.", names(&branch.untested, most));
        page.paragraph(&text, Tint::Doubtful, "  ", "  ");
    }
    if let Some(count) = &branch.freedoms {
        page.paragraph(
            &format!(
                "Degrees of freedom {}",
                lowercase(&sentence(&count.finding))
            ),
            tint(count.finding.outcome),
            "  ",
            "  ",
        );
    }
}

/// A value to be shown with four decimals: zero where they are zeros.
fn without_sign_of_zero(value: f64) -> f64 {
    if value.abs() < 5e-5 { 0.0 } else { value }
}

fn lowercase(sentence: &str) -> String {
    let mut text = sentence.to_owned();
    if let Some(first) = text.get_mut(..1) {
        first.make_ascii_lowercase();
    }
    text
}

fn pushing_page(pushing: &Pushing, page: &mut Page) {
    page.heading("Every joint pushed in turn");
    let mut table = Table::new()
        .column("substeps", Column::Numbers)
        .column("pushes", Column::Numbers)
        .column("moved at most", Column::Numbers)
        .column("when pushed at", Column::Shrinking)
        .column("closure error", Column::Numbers)
        .column("wall time", Column::Numbers);
    for rung in &pushing.rungs {
        table.row(vec![
            Cell::new(rung.substeps.to_string()),
            Cell::new(rung.pushes.to_string()),
            Cell::new(format!("{:.1e}", rung.moved)),
            Cell::new(&rung.farthest),
            Cell::new(format!("{:.1e}", rung.closure_error)),
            Cell::new(seconds(rung.wall_time)),
        ]);
    }
    page.table(table, "rungs");
}

fn scene_page(run: &SceneRun, page: &mut Page) {
    page.heading("Scene");
    let effects = if run.effects.is_empty() {
        "drives only".to_owned()
    } else {
        run.effects.join(", ")
    };
    let with = match run.solver {
        Some(solver) => format!(
            " with {}, {}",
            counted(run.substeps, "substep"),
            solver.word()
        ),
        None => String::new(),
    };
    page.paragraph(
        &format!(
            "{effects}; {:.2} s by {} of {:.2} ms{with}; took {}",
            run.time,
            match run.integrator {
                Integrator::RungeKutta => "Runge-Kutta steps (order five)",
                Integrator::Engine => "steps of the physics engine",
            },
            1e3 * run.time_step,
            seconds(run.wall_time)
        ),
        Tint::Plain,
        "  ",
        "  ",
    );
    if !run.engine_because.is_empty() {
        page.item(
            &format!(
                "the engine's, as Runge-Kutta steps do not serve {}",
                run.engine_because.join(", ")
            ),
            Tint::Quiet,
        );
    }
    let mut facts = vec![
        energy(run),
        format!("closure error at most {:.1e}", run.closure_error),
    ];
    if run.effects.contains(&"contact") {
        facts.push(format!(
            "{} of shapes touched at once at most",
            counted(run.most_contacts, "pair")
        ));
    }
    facts.push(match &run.beyond_limit {
        Some((joint, beyond)) => format!("{joint} went {beyond:.2e} beyond its limit"),
        None => "no joint went beyond a limit".to_owned(),
    });
    for fact in &facts {
        page.item(fact, Tint::Plain);
    }
    for idle in &run.idle_effects {
        let text = format!("{} adds nothing: {}", idle.effect, idle.because);
        page.item(&text, Tint::Quiet);
    }
    for missing in &run.not_simulated {
        page.item(&format!("not simulated: {missing}"), Tint::Bad);
    }
    if let Some(why) = &run.ended_early {
        page.item(&format!("ended early: {why}"), Tint::Bad);
    }
}

/// Energy at the end; what the engine lost or gained, where nothing else does.
fn energy(run: &SceneRun) -> String {
    let total = run.kinetic_energy + run.potential_energy;
    let mut text = format!(
        "energy at the end {total:.4} J ({:.4} kinetic); {:+.4} J since the start",
        run.kinetic_energy, run.energy_change
    );
    if let Some(share) = run.energy_error() {
        text.push_str(&format!(
            ", which nothing in the scene takes or gives: an error of the steps, {} of the greatest kinetic energy",
            percent(share)
        ));
    }
    text
}

fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    match percent {
        _ if percent < 0.01 => format!("{percent:.0e} %"),
        _ if percent < 10.0 => format!("{percent:.2} %"),
        _ => format!("{percent:.0} %"),
    }
}

/// About how far the motion of a scene is off, or why that is not known.
pub fn off_text(trajectory: &Trajectory) -> String {
    match (trajectory.error(), &trajectory.not_estimated) {
        (Some(error), _) => format!(
            "the motion is off by about {:.1e} at its worst and {:.1e} at the end (characteristic lengths, rad), speeds by {} of the \
             greatest: by runs in halved steps",
            error.worst,
            error.end,
            percent(error.speed)
        ),
        (None, Some(why)) => format!("how far the motion is off is not known: {why}"),
        (None, None) => "how far the motion is off is not known".to_owned(),
    }
}

/// How far the motion of the scene is off, by runs in halved steps.
fn trajectory_page(run: &SceneRun, trajectory: &Trajectory, page: &mut Page) {
    page.item(&off_text(trajectory), Tint::Plain);
    let Some(wanted) = trajectory.wanted else {
        return;
    };
    if trajectory.reached == Some(true) {
        let text = format!(
            "the steps were chosen by that estimate, which is no bound: the scene stays within {wanted:.1e} by it, and takes {} for a simulated \
             second",
            seconds(run.step_time / run.time.max(f64::MIN_POSITIVE))
        );
        page.item(&text, Tint::Plain);
    } else {
        let needed = trajectory.needed.map_or(String::new(), |needed| {
            format!("; by the order seen it would take {} of work", long(needed))
        });
        let text = format!(
            "an error of {wanted:.1e} is not reached with steps of {}, the shortest tried{needed}",
            seconds(run.time_step)
        );
        page.item(&text, Tint::Doubtful);
    }
    let mut table = Table::new()
        .column("step", Column::Numbers)
        .column("motion off by", Column::Numbers)
        .column("speeds", Column::Numbers)
        .column("order", Column::Numbers)
        .column("closure error", Column::Numbers)
        .column("energy", Column::Numbers)
        .column("wall time", Column::Numbers);
    for row in &trajectory.rows {
        let off =
            |of: &dyn Fn(&TrajectoryError) -> String| row.error.as_ref().map_or("–".to_owned(), of);
        table.row(vec![
            Cell::new(seconds(row.time_step)),
            Cell::new(off(&|error| format!("{:.1e}", error.worst))),
            Cell::new(off(&|error| percent(error.speed))),
            Cell::new(
                row.order
                    .map_or("–".to_owned(), |order| format!("{order:.1}")),
            ),
            Cell::new(format!("{:.1e}", row.closure_error)),
            Cell::new(format!("{:+.4} J", row.energy_change)),
            Cell::new(seconds(row.step_time)),
        ]);
    }
    page.table(table, "steps");
}

/// A time that may be long, in words.
fn long(time: f64) -> String {
    match time {
        _ if time < 60.0 => format!("{time:.0} s"),
        _ if time < 3600.0 => format!("{:.0} minutes", time / 60.0),
        _ if time < 86_400.0 => format!("{:.0} hours", time / 3600.0),
        _ => "more than a day".to_owned(),
    }
}

fn cost_page(rows: &[CostRow], page: &mut Page) {
    page.heading("What effects cost");
    let mut table = Table::new()
        .column("effects", Column::Words)
        .column("steps/s", Column::Numbers)
        .column("per step", Column::Numbers)
        .column("bodies", Column::Numbers)
        .column("shapes", Column::Numbers)
        .column("limits", Column::Numbers)
        .column("frictions", Column::Numbers)
        .column("dampings", Column::Numbers);
    for row in rows {
        table.row(vec![
            Cell::new(row.effects),
            Cell::new(format!("{:.0}", row.steps_per_second)),
            Cell::new(seconds(row.step_time)),
            Cell::new(row.pieces.bodies.to_string()),
            Cell::new(row.pieces.colliders.to_string()),
            Cell::new(row.pieces.limits.to_string()),
            Cell::new(row.pieces.frictions.to_string()),
            Cell::new(row.pieces.dampings.to_string()),
        ]);
    }
    page.table(table, "rows");
}

/// Everything, for a program. Times on the clock differ from run to run and are given on request only; `cost` is nothing
/// but such times and was requested.
pub fn json(simulated: &Simulated<'_>, timing: bool) -> Value {
    let mut value = data(
        simulated.mechanism,
        simulated.changed,
        simulated.choice.as_ref(),
        &simulated.verification,
        simulated.scene.as_ref(),
    );
    if let Some(rows) = &simulated.cost {
        value["cost"] = json!(rows);
    }
    if let Some((path, summary)) = &simulated.log {
        value["log"] = json!({
            "path": path,
            "moments": summary.moments,
            "messages": summary.messages,
            "until": summary.until,
        });
    }
    if !simulated.idle.is_empty() {
        value["idle_options"] = json!(simulated.idle);
    }
    if timing {
        value["timing"] = times(simulated);
    }
    value
}

fn times(simulated: &Simulated<'_>) -> Value {
    let mut rows = Vec::new();
    for branch in &simulated.verification.branches {
        for ladder in &branch.ladders {
            for rung in &ladder.rungs {
                rows.push(json!({
                    "branch": branch.branch,
                    "driven": ladder.driven,
                    "solver": ladder.solver,
                    "substeps": rung.substeps,
                    "wall_time": rung.wall_time,
                }));
            }
        }
    }
    if let Some(pushing) = &simulated.verification.pushing {
        for rung in &pushing.rungs {
            rows.push(json!({ "substeps": rung.substeps, "wall_time": rung.wall_time }));
        }
    }
    if let Some((run, _)) = &simulated.scene {
        rows.push(json!({ "scene": run.effects, "wall_time": run.wall_time }));
    }
    Value::Array(rows)
}
