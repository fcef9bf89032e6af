//! How long answers take within a running program: what a library's user waits for, after a first call.
//!
//! ```text
//! cargo run --release --example timed_answers -- [--rounds N] [--depth NAME] [--turn JOINT [--poses N]] FILE...
//! ```
//!
//! Prints a line of JSON for every file: the freedom found, and for each question the least and the median seconds over the
//! rounds. `read` is from the file's text to the mechanism; `rank`, `verdict`, `motions` and `everything` are analyses of
//! that [`Depth`], from the mechanism, one of them only with `--depth`; `turn` is a whole turn of the joint in so many
//! poses, from the mechanism too, with the largest gap of its loops. `benches/peers` sets these beside other tools.

use kutzbach::mobility::{AnalysisOptions, Depth, analyse};
use kutzbach::motion::{TraceOptions, trace};
use serde::Serialize;
use std::collections::BTreeMap;
use std::error::Error;
use std::time::Instant;

const DEPTHS: [(&str, Depth); 4] = [
    ("rank", Depth::Rank),
    ("verdict", Depth::Verdict),
    ("motions", Depth::Motions),
    ("everything", Depth::Everything),
];

/// Poses of a turn, where none are asked for.
const POSES: [usize; 6] = [12, 24, 60, 240, 1000, 4000];

#[derive(Serialize)]
struct Seconds {
    least: f64,
    median: f64,
}

#[derive(Serialize)]
struct Turn {
    poses: usize,
    /// Largest gap of any loop (rad, characteristic lengths).
    closure_error: f64,
    #[serde(flatten)]
    seconds: Seconds,
}

#[derive(Serialize)]
struct Answers {
    file: String,
    finite: Option<usize>,
    instantaneous: Option<usize>,
    #[serde(flatten)]
    seconds: BTreeMap<&'static str, Seconds>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    turns: Vec<Turn>,
}

/// Times `question` once to warm up and then for so many rounds.
fn timed<T, E>(
    rounds: usize,
    mut question: impl FnMut() -> Result<T, E>,
) -> Result<(T, Seconds), E> {
    let mut last = question()?;
    let mut seconds = Vec::with_capacity(rounds);
    for _ in 0..rounds {
        let start = Instant::now();
        let answer = question()?;
        seconds.push(start.elapsed().as_secs_f64());
        // Nobody waits for the last answer to be thrown away.
        last = answer;
    }
    seconds.sort_by(f64::total_cmp);
    let at = |index: usize| seconds.get(index).copied().unwrap_or(f64::NAN);
    Ok((
        last,
        Seconds {
            least: at(0),
            median: at(rounds / 2),
        },
    ))
}

fn answers(
    file: &str,
    rounds: usize,
    only: Option<&str>,
    turn: Option<&str>,
    poses: &[usize],
) -> Result<Answers, Box<dyn Error>> {
    let text = std::fs::read_to_string(file)?;
    let (reading, read) = timed(rounds, || kutzbach::format::read(&text, file, &[]))?;
    let mechanism = &reading.mechanism;
    let mut seconds = BTreeMap::from([("read", read)]);
    let mut finite = None;
    let mut instantaneous = None;
    for (name, depth) in DEPTHS
        .into_iter()
        .filter(|(name, _)| only.is_none_or(|only| only == *name))
    {
        let options = AnalysisOptions {
            depth,
            ..AnalysisOptions::default()
        };
        let (analysis, spent) = timed(rounds, || analyse(mechanism, &options))?;
        // Each from the depth whose time stands for it.
        match depth {
            Depth::Rank => instantaneous = analysis.home.and_then(|home| home.instantaneous),
            Depth::Verdict => finite = analysis.mobility.finite(),
            Depth::Motions | Depth::Everything => {}
        }
        seconds.insert(name, spent);
    }
    let mut turns = Vec::new();
    for (joint, poses) in turn
        .into_iter()
        .flat_map(|joint| poses.iter().map(move |poses| (joint, *poses)))
    {
        let (closure_error, seconds) = timed(rounds, || -> Result<f64, Box<dyn Error>> {
            let options = AnalysisOptions {
                depth: Depth::Motions,
                ..AnalysisOptions::default()
            };
            let analysis = analyse(mechanism, &options)?;
            let options = TraceOptions {
                drive: Some(joint.to_owned()),
                samples: poses,
                ..TraceOptions::default()
            };
            let motion = trace(mechanism, &analysis, &options)?.into_motion();
            Ok(motion.ok_or("it does not move")?.largest_closure)
        })?;
        turns.push(Turn {
            poses,
            closure_error,
            seconds,
        });
    }
    Ok(Answers {
        file: file.to_owned(),
        finite,
        instantaneous,
        seconds,
        turns,
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut rounds = 5;
    let mut only = None;
    let mut turn = None;
    let mut poses = POSES.to_vec();
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--rounds" => {
                rounds = arguments
                    .next()
                    .ok_or("--rounds N")?
                    .parse::<usize>()?
                    .max(1)
            }
            "--depth" => {
                let name = arguments.next().unwrap_or_default();
                if !DEPTHS.iter().any(|(known, _)| *known == name) {
                    return Err(
                        format!("--depth rank|verdict|motions|everything, not `{name}`").into(),
                    );
                }
                only = Some(name);
            }
            "--turn" => turn = Some(arguments.next().ok_or("--turn JOINT")?),
            "--poses" => poses = vec![arguments.next().ok_or("--poses N")?.parse()?],
            file => println!(
                "{}",
                serde_json::to_string(&answers(
                    file,
                    rounds,
                    only.as_deref(),
                    turn.as_deref(),
                    &poses
                )?)?
            ),
        }
    }
    Ok(())
}
