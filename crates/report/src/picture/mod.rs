//! Still pictures: plots, the mechanism itself, a sign for each kind of answer.
//!
//! # The problem
//! A page has to say most of what it knows without running anything: in a mail client, on paper, before a script has
//! started. What moves can be stilled; what is a list of numbers can be seen. Here are the pictures for that, written as
//! SVG, since it is text, sharp at every size and understood wherever a page is.
//!
//! # What holds
//! * Every picture comes as a *fragment*: an `svg` element without style of its own, for a page that has the `STYLE` of its
//!   module in its own style sheet. Plots and sketches come as a document too, which carries its style.
//! * On screens, colours are custom properties with values for light and for dark ones. Otherwise they are fixed: viewers that know no
//!   custom properties, such as Typst and resvg, draw black where a rule has one, even after a fixed colour, and pass media over.
//! * Nothing in a fragment is an inline style, refers to an `id` or runs: pages with a strict content security policy can
//!   hold any number of them.
//! * Names come from files. They are written as text only, escaped, with control characters made visible; numbers that are
//!   not finite never reach an attribute.
//! * The same data give the same bytes: coordinates have one decimal, and what decides about more than a coordinate is
//!   built from comparisons with room for rounding.
//!
//! # What it costs
//! Plots are linear in their points. A sketch compares parts that overlap, quadratic in their number up to a couple of
//! thousand parts and a sort beyond; its text stays below about 150 kB for mechanisms of hundreds of joints.
//!
//! # Where to look
//! | file | what it answers |
//! |---|---|
//! | `plot`, `plot/…` | curves, points and bars over axes |
//! | `view` | from which side a mechanism is looked at |
//! | `sketch`, `sketch/…` | what a mechanism looks like |
//! | `solids` | which faces of a part are a feature |
//! | `traced`, `traced/…` | one joint over another along a motion, and the paths of points |
//! | `pictogram` | which sign stands for which answer |
//! | `markup` | how text and numbers are written |

pub(super) mod markup;
#[cfg(feature = "html")]
pub mod pictogram;
pub mod plot;
#[cfg(feature = "html")]
pub mod sketch;
#[cfg(feature = "html")]
pub mod solids;
#[cfg(feature = "html")]
pub mod traced;
#[cfg(feature = "html")]
mod vector;
#[cfg(feature = "html")]
pub mod view;

#[cfg(all(test, feature = "html"))]
mod tests {
    use super::{pictogram, plot, sketch, solids};
    use kutzbach_model::graph::SVG_STYLE;

    #[test]
    fn custom_properties_are_asked_for_on_screens_only() {
        let all = [
            plot::STYLE,
            sketch::STYLE,
            solids::STYLE,
            pictogram::STYLE,
            crate::map::STYLE,
            SVG_STYLE,
        ];
        for style in all {
            for (place, _) in style.match_indices("var(--") {
                let (before, from) = style.split_at(place);
                let depth = before.matches('{').count() - before.matches('}').count();
                // In a rule, in a query of the medium.
                let shown: String = from.chars().take(30).collect();
                assert_eq!(depth, 2, "{shown}");
            }
        }
    }
}
