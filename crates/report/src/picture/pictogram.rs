//! A sign for each kind of answer: a line drawing of what it means.

use super::markup::put;
use kutzbach_mobility::{MobilityClass, SingularKind, Verdict};

/// The style of pictograms, all of it below `svg.pictogram`.
pub const STYLE: &str = "svg.pictogram{--sign-ink:#223;--sign-part:#1f5fa8;--sign-other:#c4501b;--sign-ground:#7a8591}\
@media screen and (prefers-color-scheme:dark){svg.pictogram{--sign-ink:#dde3ea;--sign-part:#6cb2ff;--sign-other:#ff9d6b;--sign-ground:#97a3af}}\
svg.pictogram .a,svg.pictogram .b,svg.pictogram .g{fill:none;stroke-width:3;stroke-linecap:round;stroke-linejoin:round}\
svg.pictogram .a{stroke:#1f5fa8}\
svg.pictogram .b{stroke:#c4501b}\
svg.pictogram .g{stroke:#7a8591}\
svg.pictogram .thin{stroke-width:1.6}svg.pictogram .dots{stroke-dasharray:.1 4.5}\
svg.pictogram .veil{stroke:none;fill:#1f5fa8;opacity:.18}\
svg.pictogram .j{fill:#fff;stroke:#223;stroke-width:1.8}\
svg.pictogram .k{fill:#c4501b}\
@media screen{svg.pictogram .a{stroke:var(--sign-part)}svg.pictogram .b{stroke:var(--sign-other)}svg.pictogram .g{stroke:var(--sign-ground)}\
svg.pictogram .veil{fill:var(--sign-part)}svg.pictogram .j{stroke:var(--sign-ink)}svg.pictogram .k{fill:var(--sign-other)}}\
@media screen and (prefers-color-scheme:dark){svg.pictogram .j{fill:#161b22}}";

/// How a mechanism is built, as far as its sign shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Build {
    /// Without loops.
    Tree,
    /// One loop of four bars on the ground.
    FourBar,
    /// In any other way.
    Other,
}

/// The kinds of answer that have a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Pictogram {
    /// An open chain.
    Tree,
    /// Mobile as its count predicts, with a loop of four bars on the ground.
    FourBar,
    /// Mobile as its count predicts: loops that share a link.
    Trivial,
    /// Mobile by the subgroups of its chains: two planes that share a slide.
    Exceptional,
    /// Mobile without either reason: a skew loop of four hinges.
    Paradoxical,
    /// Mobile, the class not being known.
    Mobile,
    /// Rigid: a triangle.
    Rigid,
    /// Rigid, but it gives way: three hinges in line.
    Shaky,
    /// Mobile and looser than it moves, everywhere.
    PermanentlyShaky,
    /// Branches cross.
    Bifurcation,
    /// Branches touch.
    Tangential,
    /// A branch turns back at a point.
    Cusp,
    /// A curve meets a surface.
    Kinematotropic,
    /// Singular, in a way that is not known.
    Singular,
    /// A question in a loop.
    Undecided,
    /// A loop with a gap.
    Unassembled,
}

impl Pictogram {
    /// Every sign.
    pub const ALL: [Self; 16] = [
        Self::Tree,
        Self::FourBar,
        Self::Trivial,
        Self::Exceptional,
        Self::Paradoxical,
        Self::Mobile,
        Self::Rigid,
        Self::Shaky,
        Self::PermanentlyShaky,
        Self::Bifurcation,
        Self::Tangential,
        Self::Cusp,
        Self::Kinematotropic,
        Self::Singular,
        Self::Undecided,
        Self::Unassembled,
    ];

    /// The sign of an answer about a mechanism of this build. `class` is known at regular poses of mobile mechanisms, `kind` at singular poses; the kind
    /// is what is worth showing where there is one.
    #[must_use]
    pub fn of(
        verdict: Verdict,
        class: Option<MobilityClass>,
        kind: Option<SingularKind>,
        build: Build,
    ) -> Self {
        match (verdict, kind, class) {
            (Verdict::Undecided, ..) => Self::Undecided,
            (Verdict::Unassembled, ..) => Self::Unassembled,
            (Verdict::Rigid, None, _) => Self::Rigid,
            (Verdict::Rigid, Some(_), _) => Self::Shaky,
            (Verdict::Mobile, Some(kind), _) => match kind {
                SingularKind::Bifurcation => Self::Bifurcation,
                SingularKind::Tangential => Self::Tangential,
                SingularKind::Cusp => Self::Cusp,
                SingularKind::Kinematotropic => Self::Kinematotropic,
                SingularKind::PermanentlyShaky => Self::PermanentlyShaky,
                SingularKind::Shaky => Self::Singular,
            },
            (Verdict::Mobile, None, _) if build == Build::Tree => Self::Tree,
            (Verdict::Mobile, None, Some(class)) => match class {
                MobilityClass::Trivial if build == Build::FourBar => Self::FourBar,
                MobilityClass::Trivial => Self::Trivial,
                MobilityClass::Exceptional => Self::Exceptional,
                MobilityClass::Paradoxical => Self::Paradoxical,
            },
            (Verdict::Mobile, None, None) => Self::Mobile,
        }
    }

    /// What it says.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Tree => "mobile: an open chain",
            Self::FourBar => "mobile, as the count predicts: a four-bar linkage",
            Self::Trivial => "mobile, as the count predicts",
            Self::Exceptional => "mobile: explained by the subgroups of its chains",
            Self::Paradoxical => "mobile: paradoxical, explained by no subgroup",
            Self::Mobile => "mobile",
            Self::Rigid => "rigid",
            Self::Shaky => "rigid, but shaky",
            Self::PermanentlyShaky => "mobile, and shaky at every pose",
            Self::Bifurcation => "branches cross at this pose",
            Self::Tangential => "branches touch at this pose",
            Self::Cusp => "the motion turns back at this pose",
            Self::Kinematotropic => "branches of different dimension meet at this pose",
            Self::Singular => "singular pose",
            Self::Undecided => "undecided",
            Self::Unassembled => "no closed pose",
        }
    }

    /// The sign as an element `svg.pictogram` of 64 by 64 pixels, for a page that includes [`STYLE`].
    #[must_use]
    pub fn fragment(self) -> String {
        self.written("", "")
    }

    /// The sign as a file of its own.
    #[must_use]
    pub fn document(self) -> String {
        self.written(
            " xmlns=\"http://www.w3.org/2000/svg\"",
            &format!("<style>{STYLE}</style>"),
        )
    }

    fn written(self, namespace: &str, style: &str) -> String {
        let mut svg = String::new();
        put(
            &mut svg,
            format_args!(
                "<svg{namespace} class=\"pictogram\" viewBox=\"0 0 64 64\" width=\"64\" height=\"64\" role=\"img\"><title>{}</title>{style}",
                self.title()
            ),
        );
        for (class, path) in self.lines() {
            put(
                &mut svg,
                format_args!("<path class=\"{class}\" d=\"{path}\"/>"),
            );
        }
        for (class, x, y) in self.points() {
            put(
                &mut svg,
                format_args!("<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"3.6\"/>"),
            );
        }
        svg.push_str("</svg>\n");
        svg
    }

    /// Classes and paths, back to front.
    fn lines(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::Tree => &[
                ("g thin", "M6 54H26M9 54L6 58M15 54L12 58M21 54L18 58"),
                ("a", "M16 50L22 26L42 16L56 30"),
                ("b thin", "M52 12A18 18 0 0 1 60 22M61 16L60 23L54 20"),
            ],
            Self::Trivial => &[
                ("g thin", "M6 56H58"),
                ("a", "M12 52L8 26L32 12L34 44"),
                ("a", "M32 12L56 22L52 52"),
                ("b", "M12 52L34 44L52 52"),
            ],
            Self::FourBar => &[
                (
                    "g thin",
                    "M6 54H22M42 54H58M9 54L6 58M15 54L12 58M21 54L18 58M45 54L42 58M51 54L48 58M57 54L54 58",
                ),
                ("g thin dots", "M6 28A20 20 0 0 1 24 28"),
                ("a", "M14 50L20 22L48 14L50 50"),
            ],
            Self::Exceptional => &[
                ("veil", "M4 20L32 10V46L4 56Z"),
                ("veil", "M60 20L32 10V46L60 56Z"),
                ("g thin", "M32 10V46"),
                ("a", "M11 47L10 29L26 22L25 38"),
                ("b", "M53 47L54 29L38 22L39 38"),
            ],
            Self::Paradoxical => &[
                ("a", "M10 42L44 54L54 22"),
                ("b", "M54 22L22 12L10 42"),
                ("g thin", "M5 31L15 53M40 43L48 63M58 10L50 34M15 6L29 18"),
            ],
            Self::Mobile => &[
                ("a", "M16 50L26 20L50 26"),
                ("g thin dots", "M16 50L42 30"),
                ("b thin", "M38 12A20 20 0 0 1 56 40M51 37L56 41L60 35"),
            ],
            Self::Rigid => &[("a", "M10 52H54L32 12Z")],
            Self::Shaky => &[
                ("g thin", "M6 24V44M58 24V44"),
                ("a", "M10 34H54"),
                (
                    "b thin",
                    "M32 26V14M28 18L32 13L36 18M32 42V54M28 50L32 55L36 50",
                ),
            ],
            Self::PermanentlyShaky => &[
                ("g thin", "M6 30V46M58 30V46"),
                ("a", "M10 38H54"),
                (
                    "b thin",
                    "M32 30V20M28.5 23L32 19L35.5 23M32 46V56M28.5 53L32 57L35.5 53",
                ),
                ("a thin", "M20 10H44M40 6L45 10L40 14M24 6L19 10L24 14"),
            ],
            Self::Bifurcation => &[
                ("a", "M6 50C24 48 40 20 58 14"),
                ("b", "M6 14C24 20 40 48 58 50"),
            ],
            Self::Tangential => &[
                ("a", "M6 12C18 36 46 36 58 12"),
                ("b", "M6 50C18 24 46 24 58 50"),
            ],
            Self::Cusp => &[
                ("a", "M8 8C18 24 34 32 52 32"),
                ("b", "M8 56C18 40 34 32 52 32"),
            ],
            Self::Kinematotropic => &[
                ("veil", "M4 44L26 28L60 34L38 54Z"),
                ("a thin", "M4 44L26 28L60 34L38 54Z"),
                ("b", "M12 8C24 10 31 22 32 41"),
            ],
            Self::Singular => &[
                ("a", "M6 42C20 42 24 36 30 33"),
                ("a", "M58 22C44 22 40 28 34 31"),
                ("g thin", "M32 14A18 18 0 1 1 31.9 14"),
            ],
            Self::Undecided => &[
                ("a", "M32 8L54 24L46 52H18L10 24Z"),
                (
                    "b",
                    "M26 28A6 6 0 1 1 35 33C32.5 34.5 32 36 32 38M32 44V44.2",
                ),
            ],
            Self::Unassembled => &[
                ("a", "M36 12L14 20L12 50L50 52L53 34"),
                ("b thin dots", "M36 12L53 34"),
            ],
        }
    }

    /// Classes and centres of joints.
    fn points(self) -> &'static [(&'static str, f64, f64)] {
        match self {
            Self::Tree => &[("j", 16.0, 50.0), ("j", 22.0, 26.0), ("j", 42.0, 16.0)],
            Self::Trivial => &[
                ("j", 12.0, 52.0),
                ("j", 8.0, 26.0),
                ("j", 32.0, 12.0),
                ("j", 34.0, 44.0),
                ("j", 56.0, 22.0),
                ("j", 52.0, 52.0),
            ],
            Self::FourBar => &[
                ("j", 14.0, 50.0),
                ("j", 20.0, 22.0),
                ("j", 48.0, 14.0),
                ("j", 50.0, 50.0),
            ],
            Self::Exceptional => &[
                ("j", 11.0, 47.0),
                ("j", 10.0, 29.0),
                ("j", 26.0, 22.0),
                ("j", 53.0, 47.0),
                ("j", 54.0, 29.0),
                ("j", 38.0, 22.0),
            ],
            Self::Paradoxical => &[
                ("j", 10.0, 42.0),
                ("j", 44.0, 54.0),
                ("j", 54.0, 22.0),
                ("j", 22.0, 12.0),
            ],
            Self::Mobile => &[("j", 16.0, 50.0), ("j", 26.0, 20.0), ("j", 50.0, 26.0)],
            Self::Rigid => &[("j", 10.0, 52.0), ("j", 54.0, 52.0), ("j", 32.0, 12.0)],
            Self::Shaky => &[("j", 10.0, 34.0), ("j", 32.0, 34.0), ("j", 54.0, 34.0)],
            Self::PermanentlyShaky => &[("j", 10.0, 38.0), ("j", 32.0, 38.0), ("j", 54.0, 38.0)],
            Self::Bifurcation | Self::Singular => &[("j k", 32.0, 32.0)],
            Self::Tangential => &[("j k", 32.0, 30.5)],
            Self::Cusp => &[("j k", 52.0, 32.0)],
            Self::Kinematotropic => &[("j k", 32.0, 41.0)],
            Self::Undecided => &[
                ("j", 32.0, 8.0),
                ("j", 54.0, 24.0),
                ("j", 46.0, 52.0),
                ("j", 18.0, 52.0),
                ("j", 10.0, 24.0),
            ],
            Self::Unassembled => &[
                ("j", 36.0, 12.0),
                ("j", 14.0, 20.0),
                ("j", 12.0, 50.0),
                ("j", 50.0, 52.0),
                ("j", 53.0, 34.0),
            ],
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn every_answer_has_a_sign() {
        let none = None::<SingularKind>;
        let mut found = Vec::new();
        for verdict in Verdict::ALL {
            for class in MobilityClass::ALL.iter().copied().map(Some).chain([None]) {
                for kind in SingularKind::ALL.iter().copied().map(Some).chain([none]) {
                    for build in [Build::Tree, Build::FourBar, Build::Other] {
                        found.push(Pictogram::of(*verdict, class, kind, build));
                    }
                }
            }
        }
        found.sort();
        found.dedup();
        let mut all = Pictogram::ALL.to_vec();
        all.sort();
        assert_eq!(found, all);
        assert_eq!(
            Pictogram::of(
                Verdict::Rigid,
                None,
                Some(SingularKind::Shaky),
                Build::Other
            ),
            Pictogram::Shaky
        );
    }

    #[test]
    fn signs_are_xml_and_differ() {
        let mut seen = Vec::new();
        for sign in Pictogram::ALL {
            let fragment = sign.fragment();
            let document = roxmltree::Document::parse(&fragment).unwrap();
            let root = document.root_element();
            assert_eq!(root.attribute("class"), Some("pictogram"));
            assert_eq!(
                root.first_element_child().and_then(|t| t.text()),
                Some(sign.title())
            );
            assert!(!fragment.contains("style"));
            assert!(roxmltree::Document::parse(&sign.document()).is_ok());
            seen.push(fragment);
        }
        seen.sort();
        seen.dedup();
        assert_eq!(seen.len(), Pictogram::ALL.len());
    }
}
