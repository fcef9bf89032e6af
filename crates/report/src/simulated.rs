//! What a simulation said as data: `kutzbach simulate --format json`.

use kutzbach_model::mechanism::Mechanism;
use kutzbach_simulate::accuracy::Choice;
use kutzbach_simulate::verification::Verification;
use kutzbach_simulate::{SceneRun, Trajectory};
use serde_json::{Value, json};

/// The version of the JSON.
pub const SIMULATION_SCHEMA: &str = "kutzbach-simulation-1";

/// What was simulated, without times, which differ from run to run.
///
/// `changed` is how far the dimensions are from those written (m), where they are others; `choice` is the setting that a wanted error
/// called for; `scene` is the run of the file's scene and how far its motion is off.
#[must_use]
pub fn data(
    mechanism: &Mechanism,
    changed: Option<f64>,
    choice: Option<&Choice>,
    verification: &Verification,
    scene: Option<&(SceneRun, Trajectory)>,
) -> Value {
    let mut value = json!({
        "schema": SIMULATION_SCHEMA,
        "mechanism": mechanism.name(),
        "dimensions_changed": changed,
        "verification": verification,
    });
    if let Some(choice) = choice {
        value["accuracy"] = json!(choice);
    }
    if let Some((run, trajectory)) = scene {
        value["scene"] = json!(run);
        value["scene"]["trajectory"] = json!(trajectory);
    }
    value
}
