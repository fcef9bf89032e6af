//! A sweep as a map, and below it the command that makes the report of each cell.

use super::document::{definition_list, shell_with};
use super::escape::escaped;
use super::names::Names;
use super::stage::Assets;
use crate::map::{Map, STYLE};

/// The map of a sweep as a complete HTML document: one file, no network. Up to two thousand cells are listed with the commands that
/// make their reports, and lead there.
#[must_use]
pub fn map_page(map: &Map) -> String {
    let title = map.title();
    let mut out = format!("<main>\n<header><h1>{}</h1>\n", escaped(&title));
    for note in map.notes() {
        out.push_str(&format!("<p class=\"quiet\">{}</p>\n", escaped(note)));
    }
    out.push_str(&format!(
        "</header>\n<section id=\"map\">\n<figure class=\"scroll\">{}<figcaption>{}</figcaption></figure>\n</section>\n",
        map.fragment(),
        caption(map)
    ));
    reports(map, &mut out);
    definition_list(&Names::none(), &mut out);
    out.push_str("</main>\n");
    shell_with(STYLE, &title, &out, Assets::Inside)
}

fn caption(map: &Map) -> &'static str {
    match map.is_grid() {
        true => {
            "Each cell reaches half way to its neighbours; what lies between the values of the sweep is not known. The line runs where \
             the answer changes: whether, and with how many degrees of freedom, it moves."
        }
        false => "Each point is a variant; what lies between them is not known.",
    }
}

/// A row for each cell.
fn reports(map: &Map, out: &mut String) {
    let listed = map.listed();
    if listed.is_empty() {
        out.push_str(
            "<p class=\"quiet\">There are too many cells to list; what shows where one points at a cell has the command that makes \
             its report.</p>\n",
        );
        return;
    }
    out.push_str(
        "<section id=\"reports\">\n<h2>Reports</h2>\n<div class=\"scroll\"><table class=\"sortable\"><thead><tr>\
         <th data-sort=\"number\">variant</th>",
    );
    for name in map.measure_names() {
        out.push_str(&format!("<th data-sort=\"number\">{}</th>", escaped(name)));
    }
    out.push_str("<th data-sort=\"text\">map</th><th>report</th></tr></thead><tbody>\n");
    for cell in listed {
        out.push_str(&format!(
            "<tr id=\"variant-{0}\"><td class=\"number\">{0}</td>",
            cell.variant
        ));
        for value in &cell.measures {
            out.push_str(&format!("<td class=\"number\">{}</td>", escaped(value)));
        }
        out.push_str(&format!(
            "<td>{}</td><td><code>{}</code></td></tr>\n",
            escaped(&cell.shown),
            escaped(&cell.command)
        ));
    }
    out.push_str("</tbody></table></div>\n</section>\n");
}
