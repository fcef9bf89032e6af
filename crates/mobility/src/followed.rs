//! An analysis for whoever follows the motion it predicts.

use super::analyse::analyse;
use super::analysis::Analysis;
use super::as_stated::analyse_as_stated;
use super::options::{AnalysisError, AnalysisOptions};
use super::vocabulary::Verdict;
use kutzbach_model::mechanism::Mechanism;

/// A mechanism whose predicted motion can be followed to the last digit, and its analysis.
#[derive(Clone, Debug)]
pub struct Followed {
    /// The mechanism: the one given, or the one meant by its rounded numbers.
    pub mechanism: Mechanism,
    /// Its analysis.
    pub analysis: Analysis,
    /// How far the dimensions are from those written (m), where they are not these.
    pub changed: Option<f64>,
}

/// Analyses a mechanism whose motion is then traced or simulated.
///
/// Rounded numbers may be told mobile as they stand, since their digits allow the motion, and yet bind when they are followed literally.
/// Then everything returned is of the nearest mechanism that moves, if it lies within the digits and moves with as many degrees of freedom.
/// That one is analysed as it stands: what it was meant to be is known, and is not sought again.
///
/// # Errors
/// [`AnalysisError`] as for [`analyse`].
pub fn analyse_to_follow(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
) -> Result<Followed, AnalysisError> {
    let analysis = analyse(mechanism, options)?;
    let nominal = analysis.mobility.nominal.as_ref();
    let distance = nominal.and_then(|nominal| nominal.distance);
    let within = nominal.is_some_and(|nominal| nominal.within_digits);
    if let Some(nearest) = &analysis.nearest
        && analysis.meant.is_none()
        && analysis.mobility.verdict == Verdict::Mobile
        && within
    {
        let of_nearest = analyse_as_stated(&nearest.mechanism, options)?;
        if of_nearest.mobility.finite() == analysis.mobility.finite() {
            return Ok(Followed {
                mechanism: nearest.mechanism.clone(),
                analysis: of_nearest,
                changed: distance,
            });
        }
    }
    Ok(Followed {
        mechanism: analysis.of(mechanism).clone(),
        changed: distance.filter(|_| analysis.meant.is_some()),
        analysis,
    })
}
