//! What accuracy costs: a section of the page, and a page of its own.

use super::blocks;
use super::document::{definition_list, shell};
use super::escape::escaped;
use super::names::Names;
use super::stage::Assets;
use crate::accuracy::{figure, page};
use crate::text::Layout;
use kutzbach_simulate::accuracy::Accuracy;

/// Figure and tables as a section.
pub(super) fn section(accuracy: &Accuracy, names: &Names, out: &mut String) {
    out.push_str("<section id=\"accuracy\">\n<h2>What accuracy costs</h2>\n");
    content(accuracy, names, out);
    out.push_str("</section>\n");
}

fn content(accuracy: &Accuracy, names: &Names, out: &mut String) {
    out.push_str(&format!(
        "<figure class=\"scroll\">{}<figcaption>Above: how far off a pose is, over the time that a second of motion takes; left \
         and low is better. Below: what every way to know how it can move takes, and what it says; the last two, the verdict and the \
         whole report, are all engines together.</figcaption></figure>\n",
        figure(accuracy).fragment()
    ));
    let layout = Layout {
        verbose: true,
        ..Layout::default()
    };
    blocks::write(page(accuracy, layout).blocks(), names, out);
}

/// What accuracy costs as a complete HTML document: one file, no network.
#[must_use]
pub fn accuracy_page(accuracy: &Accuracy) -> String {
    let title = format!("{}: what accuracy costs", accuracy.mechanism);
    let names = Names::none();
    let mut out = format!(
        "<main>\n<header><h1>{}</h1></header>\n<section id=\"accuracy\">\n",
        escaped(&title)
    );
    content(accuracy, &names, &mut out);
    out.push_str("</section>\n");
    definition_list(&names, &mut out);
    out.push_str("</main>\n");
    shell(&title, &out, Assets::Inside)
}
