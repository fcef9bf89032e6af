//! The page: a table for each stage, and the choice.

use crate::text::words::{capitalised, counted, duration, figure, metres};
use crate::text::{Cell, Column, Layout, Page, Table, Tint};
use kutzbach_simulate::accuracy::{Accuracy, Choice, Claim, Scene, Setting, State};
use kutzbach_simulate::{Integrator, Solver};

/// What was measured, as a page.
#[must_use]
pub fn page(accuracy: &Accuracy, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let freedom = match accuracy.finite {
        Some(finite) => format!(", {}", counted_freedoms(finite)),
        None => String::new(),
    };
    let [links, joints, loops] = accuracy.size;
    page.paragraph(
        &format!(
            "What accuracy costs for {}: {}{freedom}; {}, {}, {}.",
            accuracy.mechanism,
            accuracy.verdict,
            counted(links, "link"),
            counted(joints, "joint"),
            counted(loops, "loop")
        ),
        Tint::Strong,
        "",
        "",
    );
    if let Some(choice) = &accuracy.choice {
        let tint = if choice.reached {
            Tint::Good
        } else {
            Tint::Doubtful
        };
        page.paragraph(&choice_text(choice), tint, "", "");
    }
    analysis(accuracy, &mut page);
    motion(accuracy, &mut page);
    simulation(accuracy, &mut page);
    if let Some(scene) = &accuracy.scene {
        scene_table(scene, &mut page);
    }
    effects(accuracy, &mut page);
    if accuracy.stopped {
        page.gap();
        page.paragraph("Broken off: the rest was not measured.", Tint::Bad, "", "");
    }
    page
}

fn counted_freedoms(finite: usize) -> String {
    format!("finite mobility {finite}")
}

/// A setting in words, such as `multibody, steps of 1/240 s in 16 substeps`.
#[must_use]
pub fn setting_text(solver: Solver, time_step: f64, substeps: usize) -> String {
    format!(
        "{}, steps of {} in {}",
        solver.word(),
        step_text(time_step),
        counted(substeps, "substep")
    )
}

/// `1/240 s` where that is what it is.
pub(super) fn step_text(time_step: f64) -> String {
    let rate = 1.0 / time_step;
    if rate >= 1.0 && (rate - rate.round()).abs() < 1e-9 * rate {
        format!("1/{} s", rate.round())
    } else {
        format!("{} s", figure(time_step))
    }
}

/// What serves for a wanted error, in a sentence.
#[must_use]
pub fn choice_text(choice: &Choice) -> String {
    let wanted = error(choice.wanted);
    match (&choice.timing, &choice.best, choice.best_error) {
        (Some(found), _, _) => {
            let setting = found.setting;
            format!(
                "For an error of {wanted} of the driven motion the cheapest setting is {}: it stays within {} and takes {} for a simulated second.",
                setting_text(setting.solver, setting.time_step, setting.substeps),
                error(found.error),
                duration(found.seconds_per_second)
            )
        }
        (None, Some(best), Some(least)) => format!(
            "No setting reaches an error of {wanted} of the driven motion; the best is {}, with {}.",
            setting_text(best.solver, best.time_step, best.substeps),
            error(least)
        ),
        _ => format!("No setting reaches an error of {wanted} of the driven motion: none arrived."),
    }
}

/// A joint variable without its rounding: zero where it is next to it.
fn rounded(value: f64) -> f64 {
    if value.abs() < 1e-12 { 0.0 } else { value }
}

/// An error in two digits.
fn error(value: f64) -> String {
    format!("{value:.1e}")
}

fn tint_of(claim: Claim) -> Tint {
    match claim {
        Claim::Decides => Tint::Good,
        Claim::Wrong => Tint::Bad,
        Claim::Silent | Claim::Open => Tint::Quiet,
        Claim::Bounds | Claim::Equal => Tint::Plain,
    }
}

fn analysis(accuracy: &Accuracy, page: &mut Page) {
    page.heading("How can it move: every method");
    let mut table = Table::new()
        .column("method", Column::Words)
        .column("setting", Column::Words)
        .column("result", Column::Words)
        .column("verdict", Column::Words)
        .column("margin", Column::Numbers)
        .column("time", Column::Numbers)
        .column("basis", Column::Shrinking);
    for way in &accuracy.analysis {
        table.row(vec![
            Cell::new(&way.name),
            Cell::new(&way.precision),
            Cell::new(&way.says),
            Cell::new(way.claim.word()).tint(tint_of(way.claim)),
            Cell::new(
                way.decades
                    .map_or(String::new(), |d| format!("{d:.1} decades")),
            ),
            Cell::new(if way.timing.runs > 0 {
                duration(way.timing.seconds)
            } else {
                String::new()
            }),
            Cell::new(&way.text).tint(Tint::Quiet),
        ]);
    }
    page.table(table, "ways");
}

fn motion(accuracy: &Accuracy, page: &mut Page) {
    page.heading("How does it move: tracing");
    let motion = &accuracy.motion;
    if let Some(still) = &motion.still {
        page.paragraph(&capitalised(still), Tint::Plain, "  ", "  ");
        return;
    }
    if motion.rows.is_empty() {
        return;
    }
    page.paragraph(
        &format!(
            "Branch {}, `{}` driven; finding the curve of {} takes {} after the analysis. Then, along all of it:",
            motion.branch,
            motion.driven,
            counted(motion.nodes, "pose"),
            duration(motion.timing.seconds)
        ),
        Tint::Plain,
        "  ",
        "  ",
    );
    let mut table = Table::new()
        .column("tolerance", Column::Numbers)
        .column("closure error", Column::Numbers)
        .column("off the motion", Column::Numbers)
        .column("poses/s", Column::Numbers)
        .column("240 poses", Column::Numbers);
    for row in &motion.rows {
        table.row(vec![
            Cell::new(format!("{:.0e}", row.tolerance)),
            Cell::new(error(row.closure_error)),
            Cell::new(error(row.distance)),
            Cell::new(format!("{:.0}", row.timing.poses_per_second)),
            Cell::new(duration(240.0 / row.timing.poses_per_second)),
        ]);
    }
    page.table(table, "tolerances");
}

fn simulation(accuracy: &Accuracy, page: &mut Page) {
    page.heading("How does it move: simulating");
    let simulation = &accuracy.simulation;
    if let Some(why) = &simulation.why_not {
        page.paragraph(&capitalised(why), Tint::Plain, "  ", "  ");
        return;
    }
    if let Some(driven) = &simulation.driven {
        page.paragraph(
            &format!(
                "Branch {}, `{}` driven from {} to {} ({}) in {} s, no joint faster than a radian per second. A star marks what \
                 no other setting beats in both time and error, where both errors are as small as `kutzbach simulate` asks of a \
                 motion that it confirms.",
                driven.branch,
                driven.variable,
                figure(rounded(driven.from)),
                figure(rounded(driven.to)),
                driven.ends,
                figure(driven.seconds)
            ),
            Tint::Plain,
            "  ",
            "  ",
        );
    }
    settings(&simulation.rows, true, page);
}

fn scene_table(scene: &Scene, page: &mut Page) {
    page.heading("The file's scene, simulated");
    let effects = if scene.effects.is_empty() {
        "drives only".to_owned()
    } else {
        scene.effects.join(", ")
    };
    page.paragraph(
        &format!(
            "{} s from rest with {effects}. No motion is predicted for it: only gaps of joints are known.",
            figure(scene.seconds)
        ),
        Tint::Plain,
        "  ",
        "  ",
    );
    settings(&scene.rows, false, page);
    scene_steps(scene, page);
}

/// How far the motion of the scene is off in halved steps, and what a digit costs.
fn scene_steps(scene: &Scene, page: &mut Page) {
    if scene.steps.is_empty() {
        return;
    }
    page.gap();
    page.paragraph(
        "How far the motion itself is off (characteristic lengths, rad), by runs in halved steps:",
        Tint::Plain,
        "  ",
        "  ",
    );
    let mut table = Table::new()
        .column("integrator", Column::Words)
        .column("step", Column::Words)
        .column("motion off by", Column::Numbers)
        .column("speeds", Column::Numbers)
        .column("energy", Column::Numbers)
        .column("closure error", Column::Numbers)
        .column("per simulated second", Column::Numbers);
    for row in &scene.steps {
        let number = |value: Option<f64>| value.map_or("–".to_owned(), error);
        table.row(vec![
            Cell::new(integrator(row.integrator)),
            Cell::new(step_text(row.time_step)),
            Cell::new(number(row.off)),
            Cell::new(number(row.speeds)),
            Cell::new(format!("{:+.1e} J", row.energy_change)),
            Cell::new(error(row.closure_error)),
            Cell::new(duration(row.timing.seconds_per_second)),
        ]);
    }
    page.table(table, "scene steps");
    for of in [Integrator::RungeKutta, Integrator::Engine] {
        if let Some(text) = price(scene, of) {
            page.paragraph(&text, Tint::Plain, "  ", "  ");
        }
    }
}

fn integrator(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::RungeKutta => "Runge-Kutta",
        Integrator::Engine => "engine",
    }
}

/// Errors below this are roundings, which no work makes smaller.
const ROUNDING: f64 = 1e-12;

/// What a ten-thousandth of the machine's length costs with an integrator, and each digit more.
fn price(scene: &Scene, of: Integrator) -> Option<String> {
    let known = scene.steps.iter().filter(|row| row.integrator == of);
    let points: Vec<(f64, f64)> = known
        .filter_map(|row| Some((row.off?, row.timing.seconds_per_second)))
        .filter(|(off, seconds)| *off > ROUNDING && *seconds > 0.0)
        .collect();
    let (first, last) = (points.first()?, points.last()?);
    let digits = (first.0 / last.0).log10();
    if !(digits >= 1.0) {
        return None;
    }
    let dearer = (last.1 / first.1).powf(1.0 / digits);
    let (off, seconds) = points.iter().find(|(off, _)| *off <= 1e-4).unwrap_or(last);
    Some(format!(
        "{}: {} costs {} for a second of motion, each further digit {dearer:.1} times as much.",
        match of {
            Integrator::RungeKutta => "Runge-Kutta steps",
            Integrator::Engine => "The engine",
        },
        metres(off * scene.length),
        duration(*seconds)
    ))
}

fn settings(rows: &[Setting], predicted: bool, page: &mut Page) {
    let mut table = Table::new()
        .column("solver", Column::Words)
        .column("step", Column::Words)
        .column("substeps", Column::Numbers)
        .column("closure error", Column::Numbers);
    if predicted {
        table = table
            .column("off the prediction", Column::Numbers)
            .column("travel reached", Column::Numbers);
    }
    table = table
        .column("per simulated second", Column::Numbers)
        .column("", Column::Words);
    let mut left_out = Vec::new();
    for row in rows {
        if row.state == State::LeftOut {
            left_out.push(row);
            continue;
        }
        let best = row.confirms() && row.timing.is_some_and(|timing| timing.pareto);
        let number = |value: Option<f64>| value.map_or("–".to_owned(), error);
        let mut cells = vec![
            Cell::new(row.solver.word()),
            Cell::new(step_text(row.time_step)),
            Cell::new(row.substeps.to_string()),
            Cell::new(number(row.closure_error)),
        ];
        if predicted {
            cells.push(Cell::new(number(row.distance)));
            cells.push(Cell::new(row.came.map_or("–".to_owned(), |came| {
                format!("{:.0} %", 100.0 * came.min(1.0))
            })));
        }
        cells.push(Cell::new(row.seconds().map_or("–".to_owned(), duration)));
        cells.push(match row.state {
            State::Arrived if best => Cell::new("★").tint(Tint::Good),
            State::Arrived => Cell::new(""),
            other => Cell::new(other.word()).tint(Tint::Doubtful),
        });
        table.row(cells);
    }
    page.table(table, "settings");
    if !left_out.is_empty() {
        page.paragraph(&left_out_text(&left_out), Tint::Quiet, "  ", "  ");
    }
}

/// Which settings were not run.
fn left_out_text(rows: &[&Setting]) -> String {
    let mut parts: Vec<String> = Vec::new();
    for solver in [Solver::Multibody, Solver::Impulse] {
        let settings: Vec<String> = rows
            .iter()
            .filter(|row| row.solver == solver)
            .map(|row| format!("{} in {}", step_text(row.time_step), row.substeps))
            .collect();
        if !settings.is_empty() {
            parts.push(format!("{}: {}", solver.word(), settings.join(", ")));
        }
    }
    format!(
        "Left out, since they would take too long (`--budget` gives more time): {}.",
        parts.join("; ")
    )
}

fn effects(accuracy: &Accuracy, page: &mut Page) {
    let rows = &accuracy.effects;
    if rows.is_empty() {
        return;
    }
    page.heading("What effects cost");
    let without = rows.first().and_then(|row| row.timing.step);
    let mut table = Table::new()
        .column("effects", Column::Words)
        .column("a step takes", Column::Numbers)
        .column("times that without", Column::Numbers)
        .column("bodies", Column::Numbers)
        .column("shapes", Column::Numbers)
        .column("", Column::Words);
    for row in rows {
        let ratio = row.timing.step.zip(without).map(|(a, b)| a / b);
        table.row(vec![
            Cell::new(&row.effects),
            Cell::new(row.timing.step.map_or("–".to_owned(), duration)),
            Cell::new(ratio.map_or("–".to_owned(), |r| format!("{r:.2}"))),
            Cell::new(row.bodies.to_string()),
            Cell::new(row.shapes.to_string()),
            Cell::new(if row.called_for && row.effects != "scene" {
                "in the scene"
            } else {
                ""
            })
            .tint(Tint::Quiet),
        ]);
    }
    page.table(table, "effects");
}
