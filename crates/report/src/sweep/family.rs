//! The members of a family, and what is found of each.

use super::outcome::{Outcome, found, generic_mobility};
use super::plan::{Plan, Shard};
use super::values::Value;
use crate::asked::HOME;
use kutzbach_format::{FormatError, ReadOptions, Reading, Template, property_names, read_bytes_of};
use kutzbach_mobility::{AnalysisOptions, Depth, Structure, analyse_within};
use kutzbach_model::mechanism::Mechanism;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

/// A file in memory, and how it is to be read.
#[derive(Clone, Debug)]
pub struct MeasuredFile {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// What errors call it.
    pub file: String,
    /// Its path, beside which included files are looked for.
    pub base: Option<PathBuf>,
    /// How it is read; measures that are not varied may have settings here.
    pub options: ReadOptions,
}

impl MeasuredFile {
    /// A text that is no file, read as any text is.
    #[must_use]
    pub fn of_text(text: &str, file: &str) -> Self {
        Self {
            bytes: text.as_bytes().to_vec(),
            file: file.to_owned(),
            base: None,
            options: ReadOptions::default(),
        }
    }

    /// A number made from its bytes (FNV-1a, 64 bits), by which a file that has changed is known.
    #[must_use]
    pub fn hash(&self) -> u64 {
        self.bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
        })
    }

    fn read(&self, settings: Vec<(String, String)>) -> Result<Reading, FormatError> {
        let options = ReadOptions {
            settings,
            ..self.options.clone()
        };
        read_bytes_of(&self.bytes, &self.file, self.base.as_deref(), &options)
    }
}

/// A variant and its answer.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its number in the whole sweep, counted from 0.
    pub index: u64,
    /// The values of the measures, in the order of [`Plan::names`].
    pub values: Vec<Value>,
    /// What was found.
    pub outcome: Outcome,
}

/// A file with named measures, the values they take, and what is asked of each variant.
///
/// ```
/// # mod kutzbach { pub use kutzbach_report::sweep; pub use kutzbach_mobility as mobility; }
/// # let text = r#"<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
/// #   <xacro:property name="length" value="1"/> <link name="base"/> <link name="arm"/>
/// #   <joint name="hinge" type="revolute"> <parent link="base"/> <child link="arm"/>
/// #     <origin xyz="${1/length} 0 0"/> <axis xyz="0 0 1"/> </joint> </robot>"#;
/// use kutzbach::mobility::AnalysisOptions;
/// use kutzbach::sweep::{Family, MeasuredFile, Over, Plan, Shard, Status};
///
/// let plan = Plan::new(vec![Over::read("length=0..2:3")?], None)?;
/// let family = Family::new(MeasuredFile::of_text(text, "arm.urdf"), plan, AnalysisOptions::default()).unwrap();
/// let found: Vec<_> = family.variants(Shard::default()).map(|row| row.outcome).collect();
/// // The text has 1/length in it: a variant that is no mechanism is a row with its reason.
/// assert_eq!(found[0].status, Status::Invalid);
/// assert!(found[0].reason.is_some());
/// assert_eq!(found[1].facts.finite, Some(1));
/// # Ok::<(), kutzbach::sweep::SweepError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Family {
    source: MeasuredFile,
    plan: Plan,
    asked: AnalysisOptions,
}

impl Family {
    /// A family. The configuration asked for is that of all members; without one it is the home pose.
    ///
    /// # Errors
    /// A file that is no mechanism with its own values either; a measure that it does not have.
    pub fn new(
        source: MeasuredFile,
        plan: Plan,
        asked: AnalysisOptions,
    ) -> Result<Self, Box<FormatError>> {
        let family = Self {
            source,
            plan,
            asked,
        };
        let first = family.plan.values(0).unwrap_or_default();
        let Err(error) = family.source.read(family.settings(&first)) else {
            return Ok(family);
        };
        // The first variant may be invalid by its values; what is wrong with the file, or with a name, is so in all of them.
        let settings = family.source.options.settings.clone();
        family.source.read(settings)?;
        let known = property_names(&String::from_utf8_lossy(&family.source.bytes));
        let is_known = |name: &str| known.iter().any(|own| own == name);
        let all_known = family.plan.names().all(is_known);
        match all_known {
            true => Ok(family),
            false => Err(Box::new(error)),
        }
    }

    /// Which variants it has.
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The file.
    #[must_use]
    pub fn source(&self) -> &MeasuredFile {
        &self.source
    }

    /// How much is asked.
    #[must_use]
    pub fn depth(&self) -> Depth {
        self.asked.depth
    }

    /// The gap up to which loops count as closed, where one was given.
    #[must_use]
    pub fn closure_tolerance(&self) -> Option<f64> {
        self.asked.closure_tolerance
    }

    /// Its members, with the file parsed once for all of them.
    #[must_use]
    pub fn members(&self) -> Members<'_> {
        let source = &self.source;
        let base = source.base.as_deref();
        Members {
            family: self,
            template: Template::new(&source.bytes, &source.file, base, &source.options),
            common: OnceLock::new(),
        }
    }

    /// The rows of a share, each computed when it is asked for.
    pub fn variants(&self, shard: Shard) -> impl Iterator<Item = Row> {
        let count = shard.count(self.plan.count());
        let members = self.members();
        (0..count).map_while(move |place| members.row(shard.index(place)))
    }

    /// One row; `None` beyond the last variant. Of many, [`Family::members`] are faster.
    #[must_use]
    pub fn row(&self, index: u64) -> Option<Row> {
        self.members().row(index)
    }

    /// What is found with these values of the measures, in the order of [`Plan::names`]. Of many, [`Family::members`] are faster.
    #[must_use]
    pub fn verdict(&self, values: &[Value]) -> Outcome {
        self.members().verdict(values)
    }

    /// What is found of a member.
    fn outcome(&self, mechanism: &Mechanism, common: &Common) -> Outcome {
        let mut options = self.asked.clone();
        if options.configuration.is_none() && mechanism.configuration(HOME).is_some() {
            options.configuration = Some(HOME.to_owned());
        }
        match analyse_within(mechanism, &common.structure, &options) {
            Ok(analysis) => found(mechanism, &analysis, options.depth, common.generic),
            Err(error) => Outcome::invalid(error.to_string()),
        }
    }

    fn settings(&self, values: &[Value]) -> Vec<(String, String)> {
        let own = self.source.options.settings.iter().cloned();
        let varied = self.plan.names().zip(values);
        // Of two settings with one name the later holds.
        own.chain(varied.map(|(name, value)| (name.to_owned(), value.setting.clone())))
            .collect()
    }
}

/// The members of a family, for whom the file is parsed once; several threads may ask for rows at the same time.
///
/// ```
/// # mod kutzbach { pub use kutzbach_report::sweep; pub use kutzbach_mobility as mobility; }
/// # let text = r#"<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
/// #   <xacro:property name="length" value="1"/> <link name="base"/> <link name="arm"/>
/// #   <joint name="hinge" type="revolute"> <parent link="base"/> <child link="arm"/>
/// #     <origin xyz="${1/length} 0 0"/> <axis xyz="0 0 1"/> </joint> </robot>"#;
/// use kutzbach::mobility::AnalysisOptions;
/// use kutzbach::sweep::{Family, MeasuredFile, Over, Plan};
///
/// let plan = Plan::new(vec![Over::read("length=1..2:11")?], None)?;
/// let family = Family::new(MeasuredFile::of_text(text, "arm.urdf"), plan, AnalysisOptions::default()).unwrap();
/// let members = family.members();
/// let rows = std::thread::scope(|scope| {
///     let halves = [0, 1].map(|half| {
///         let members = &members;
///         let numbers = (half..11).step_by(2);
///         scope.spawn(move || numbers.filter_map(|number| members.row(number)).count())
///     });
///     halves.map(|half| half.join().unwrap())
/// });
/// assert_eq!(rows, [6, 5]);
/// # Ok::<(), kutzbach::sweep::SweepError>(())
/// ```
#[derive(Debug)]
pub struct Members<'f> {
    family: &'f Family,
    template: Template<'f>,
    common: OnceLock<Common>,
}

/// What mechanisms have in common that differ in the numbers of their joints only.
#[derive(Debug)]
struct Common {
    structure: Arc<Structure>,
    /// The count at random geometry, where rows have it.
    generic: Option<i64>,
}

impl Common {
    fn of(mechanism: &Mechanism, depth: Depth) -> Self {
        let structure = Structure::new(mechanism);
        Self {
            generic: match depth {
                Depth::Rank => None,
                _ => generic_mobility(mechanism, &structure),
            },
            structure: Arc::new(structure),
        }
    }
}

impl Members<'_> {
    /// Whose members they are.
    #[must_use]
    pub fn family(&self) -> &Family {
        self.family
    }

    /// One row; `None` beyond the last variant.
    #[must_use]
    pub fn row(&self, index: u64) -> Option<Row> {
        let values = self.family.plan.values(index)?;
        let outcome = self.verdict(&values);
        Some(Row {
            index,
            values,
            outcome,
        })
    }

    /// What is found with these values of the measures, in the order of [`Plan::names`].
    ///
    /// A fault of this program in one variant is its reason, so that the others are still answered.
    #[must_use]
    pub fn verdict(&self, values: &[Value]) -> Outcome {
        catch_unwind(AssertUnwindSafe(|| self.analysed(values)))
            .unwrap_or_else(|fault| Outcome::invalid(told(&*fault)))
    }

    fn analysed(&self, values: &[Value]) -> Outcome {
        let varied = self.family.plan.names().zip(values);
        let settings: Vec<(String, String)> = varied
            .map(|(name, value)| (name.to_owned(), value.setting.clone()))
            .collect();
        let depth = self.family.asked.depth;
        let told = self.template.with_varied(&settings, |mechanism| {
            let common = self.common.get_or_init(|| Common::of(mechanism, depth));
            self.family.outcome(mechanism, common)
        });
        told.unwrap_or_else(|| match self.template.read(&settings) {
            Ok(Reading { mechanism, .. }) => {
                let own = Common::of(&mechanism, depth);
                self.family.outcome(&mechanism, &own)
            }
            Err(error) => Outcome::invalid(error.to_string()),
        })
    }
}

/// What a panic said.
fn told(fault: &(dyn Any + Send)) -> String {
    let said = fault
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| fault.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("it says nothing");
    format!("a fault of this program: {said}")
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::outcome::Status;
    use super::super::values::Over;
    use super::*;
    use kutzbach_mobility::Verdict;

    /// A hinge at a place that there is none of where `lead` is 0.
    const TEXT: &str = r#"<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="lead" value="1"/>
  <link name="base"/> <link name="nut"/>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="nut"/><origin xyz="${1/lead} 0 0"/><axis xyz="0 0 1"/>
  </joint>
</robot>"#;

    fn family(over: &str, depth: Depth) -> Result<Family, Box<FormatError>> {
        let plan = Plan::new(vec![Over::read(over).unwrap()], None).unwrap();
        let options = AnalysisOptions {
            depth,
            ..AnalysisOptions::default()
        };
        Family::new(MeasuredFile::of_text(TEXT, "r.urdf"), plan, options)
    }

    #[test]
    fn an_invalid_member_is_a_row_with_its_reason() {
        let family = family("lead=0..1:3", Depth::Verdict).unwrap();
        let rows: Vec<Row> = family.variants(Shard::default()).collect();
        let status: Vec<Status> = rows.iter().map(|row| row.outcome.status).collect();
        let expected = [Status::Invalid, Status::Analysed, Status::Analysed];
        assert_eq!(status, expected);
        let reason = rows[0].outcome.reason.as_ref().unwrap();
        assert!(reason.starts_with("r.urdf:5:"), "{reason}");
        let facts = &rows[1].outcome.facts;
        assert_eq!((facts.finite, facts.generic), (Some(1), Some(1)));
        assert_eq!(facts.verdict, Some(Verdict::Mobile));
        assert_eq!(facts.margin, None);
        assert!(family.row(3).is_none());
    }

    #[test]
    fn the_rank_alone_gives_no_verdict() {
        let row = family("lead=2", Depth::Rank).unwrap().row(0).unwrap();
        assert_eq!(row.outcome.facts.instantaneous, Some(1));
        assert_eq!(row.outcome.facts.verdict, None);
        assert_eq!(row.outcome.reason, None);
    }

    #[test]
    fn a_measure_that_the_file_does_not_have_is_an_error() {
        let error = family("led=1,2", Depth::Rank).unwrap_err();
        assert!(error.to_string().contains("`led`"), "{error}");
    }

    #[test]
    fn a_fault_is_told() {
        assert_eq!(told(&"oh"), "a fault of this program: oh");
        assert_eq!(told(&"oh".to_owned()), "a fault of this program: oh");
        assert_eq!(told(&7), "a fault of this program: it says nothing");
    }
}
