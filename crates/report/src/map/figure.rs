//! The picture: cells or points over two axes, the line where answers change, and what every colour stands for.

use super::grid::{Grid, Line};
use super::reading::{Cell, MOST_SINGLE};
use super::tones::Tone;
use super::{Map, STYLE};
use crate::picture::markup::{escaped, put, px, text_width};
use crate::picture::plot::{self, Axis, Plot, Scale};
use crate::text::{clipped, columns};

/// Size of the plot (px).
const PLOT: [f64; 2] = [620.0, 520.0];

/// The legend beside it: where it begins, how high a row is, its font and the sizes that it may have (px).
const LEGEND_TOP: f64 = 44.0;
const LEGEND_ROW: f64 = 19.0;
const LEGEND_FONT: f64 = 11.5;
const SWATCH: f64 = 13.0;
const LEGEND_WIDTH: [f64; 2] = [150.0, 330.0];

/// Longest words in it, in columns.
const LONGEST_LABEL: usize = 40;

/// Rows of notes below, and their font (px).
const NOTE_ROW: f64 = 15.0;
const NOTE_FONT: f64 = 10.5;

/// Longest reason that is told of a cell, in columns.
const LONGEST_REASON: usize = 200;

/// Pixels of an axis.
struct Ruler {
    range: [f64; 2],
    pixels: [f64; 2],
}

impl Ruler {
    fn at(&self, value: f64) -> f64 {
        let ([low, high], [from, to]) = (self.range, self.pixels);
        from + (to - from) * ((value - low) / (high - low)).clamp(0.0, 1.0)
    }

    /// Where a border of a grid lies.
    fn border(&self, borders: &[f64], place: usize) -> String {
        px(borders.get(place).map_or(f64::NAN, |value| self.at(*value)))
    }
}

/// Both axes.
struct Rulers {
    x: Ruler,
    y: Ruler,
}

impl Map {
    /// The map as a file of its own, for light and dark screens.
    #[must_use]
    pub fn document(&self) -> String {
        self.write(false)
    }

    /// The map as an element for a page that includes the styles of plots and of maps, and the list of cells: each leads to the row
    /// with the `id` of its variant, `variant-7`.
    #[must_use]
    pub fn fragment(&self) -> String {
        self.write(true)
    }

    fn write(&self, in_page: bool) -> String {
        let plot = self.plot();
        let border = self.border();
        let [least, most] = LEGEND_WIDTH;
        let widest = self.legend.iter().map(|entry| {
            let words = text_width(&clipped(&entry.label, LONGEST_LABEL), LEGEND_FONT);
            words + text_width(&format!(": {}", entry.count), LEGEND_FONT)
        });
        let legend = widest.fold(0.0, f64::max) + SWATCH + 30.0;
        let width = PLOT[0] + legend.clamp(least, most);
        let rows = self.legend.len() + 1 + usize::from(!border.is_empty());
        let below = PLOT[1].max(LEGEND_TOP + LEGEND_ROW * rows as f64);
        // A page has its notes as text.
        let room = ((width - 16.0) / (0.57 * NOTE_FONT)) as usize;
        let notes: Vec<String> = match in_page {
            true => Vec::new(),
            false => self
                .notes
                .iter()
                .flat_map(|said| lines(said, room))
                .collect(),
        };
        let height = below + NOTE_ROW * notes.len() as f64 + 8.0;
        let title = escaped(&self.title());
        let (namespace, style) = match in_page {
            true => ("", String::new()),
            false => (
                " xmlns=\"http://www.w3.org/2000/svg\"",
                format!(
                    "<title>{title}</title>\n<style>{}\n{STYLE}</style>\n<rect class=\"back\" width=\"100%\" height=\"100%\"/>\n",
                    plot::STYLE
                ),
            ),
        };
        let mut svg = String::new();
        put(
            &mut svg,
            format_args!(
                "<svg{namespace} class=\"plot map\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" aria-label=\"{title}\">\n{style}",
                w = px(width),
                h = px(height),
            ),
        );
        plot.write_content(&mut svg);
        let rulers = rulers(&plot);
        match &self.grid {
            Some(grid) => self.write_grid(grid, &rulers, in_page, &mut svg),
            None => self.write_points(0..self.count, &rulers, in_page, &mut svg),
        }
        write_border(&border, self.grid.as_ref(), &rulers, &mut svg);
        self.write_points(self.count..self.cells.len(), &rulers, in_page, &mut svg);
        write_frame(&rulers, &mut svg);
        self.write_legend(!border.is_empty(), &mut svg);
        for (row, line) in notes.iter().enumerate() {
            put(
                &mut svg,
                format_args!(
                    "<text class=\"note\" x=\"8\" y=\"{}\">{}</text>\n",
                    px(below + NOTE_ROW * row as f64 + 8.0),
                    escaped(line)
                ),
            );
        }
        svg.push_str("</svg>\n");
        svg
    }

    /// The axes: as far as the cells go, or around the points.
    fn plot(&self) -> Plot {
        let ends = |borders: &[f64]| match borders {
            [first, .., last] => [*first, *last],
            _ => [0.0, 1.0],
        };
        let axis = |name: &str, place: usize| match &self.grid {
            Some(grid) if place == 0 => Axis::new(name, Scale::Linear, ends(&grid.x)),
            Some(grid) => Axis::new(name, Scale::Linear, ends(&grid.y)),
            None => {
                let values = self.cells.iter().filter_map(|cell| cell.at.get(place));
                Axis::around(name, Scale::Linear, values.copied())
            }
        };
        let mut plot = Plot::new(self.title(), axis(self.x_name(), 0), axis(self.y_name(), 1));
        plot.size = PLOT;
        plot
    }

    /// Where answers change, on a grid.
    pub(super) fn border(&self) -> Vec<Line> {
        let side = |index: usize| {
            let cell = self.cells.get(index)?;
            cell.answer().map(super::answer::Answer::side)
        };
        match &self.grid {
            Some(grid) => grid.border(side),
            None => Vec::new(),
        }
    }

    fn tone(&self, index: usize) -> Option<Tone> {
        self.tones.get(index).copied()
    }

    fn class(&self, index: usize) -> &str {
        let entry = self
            .legend
            .iter()
            .find(|entry| Some(entry.tone) == self.tone(index));
        entry.map_or("", |entry| entry.class.as_str())
    }

    fn write_grid(&self, grid: &Grid, rulers: &Rulers, in_page: bool, svg: &mut String) {
        let is_single = self.count <= MOST_SINGLE;
        for row in 0..grid.height() {
            let mut column = 0;
            while column < grid.width() {
                let Some(first) = grid.at(column, row) else {
                    column += 1;
                    continue;
                };
                let (from, mut last) = (column, first);
                column += 1;
                while !is_single && column < grid.width() {
                    match grid.at(column, row) {
                        Some(next) if self.tone(next) == self.tone(first) => last = next,
                        _ => break,
                    }
                    column += 1;
                }
                let shape = format!(
                    "<path class=\"cell {}\" d=\"M{} {}H{}V{}H{}Z\">",
                    self.class(first),
                    rulers.x.border(&grid.x, from),
                    rulers.y.border(&grid.y, row),
                    rulers.x.border(&grid.x, column),
                    rulers.y.border(&grid.y, row + 1),
                    rulers.x.border(&grid.x, from),
                );
                let told = match first == last {
                    true => self.told(first, in_page),
                    false => self.told_of_run(first, last),
                };
                self.write_shape((&shape, "path"), first, &told, in_page, svg);
            }
        }
    }

    fn write_points(
        &self,
        places: std::ops::Range<usize>,
        rulers: &Rulers,
        in_page: bool,
        svg: &mut String,
    ) {
        let radius = match places.len() {
            _ if self.is_grid() => 2.4,
            0..300 => 5.0,
            300..3000 => 3.2,
            _ => 2.0,
        };
        for index in places {
            let Some([x, y]) = self.cells.get(index).map(|cell| cell.at) else {
                continue;
            };
            let shape = format!(
                "<circle class=\"cell dot {}\" cx=\"{}\" cy=\"{}\" r=\"{}\">",
                self.class(index),
                px(rulers.x.at(x)),
                px(rulers.y.at(y)),
                px(radius)
            );
            let told = self.told(index, in_page);
            self.write_shape((&shape, "circle"), index, &told, in_page, svg);
        }
    }

    /// A shape with what is told of it; in a page with a list it leads there.
    fn write_shape(
        &self,
        (shape, element): (&str, &str),
        index: usize,
        told: &str,
        in_page: bool,
        svg: &mut String,
    ) {
        let listed = self
            .cells
            .get(index)
            .filter(|_| in_page && self.is_listed());
        if let Some(cell) = listed {
            put(svg, format_args!("<a href=\"#variant-{}\">", cell.variant));
        }
        put(
            svg,
            format_args!("{shape}<title>{told}</title></{element}>"),
        );
        svg.push_str(if listed.is_some() { "</a>\n" } else { "\n" });
    }

    /// What is told of a cell, as markup.
    fn told(&self, index: usize, in_page: bool) -> String {
        let Some(cell) = self.cells.get(index) else {
            return String::new();
        };
        let mut said = vec![self.values(cell)];
        let colour = self.sweep.colour_name();
        if cell.rows() == 1 {
            said.extend(cell.answer().map(super::answer::Answer::label));
            let value = cell.value.as_deref().filter(|value| !value.is_empty());
            if let (Some(name), Some(value)) = (colour, value) {
                said.push(format!("{name} {value}"));
            }
            if !cell.reason.is_empty() {
                said.push(clipped(&cell.reason, LONGEST_REASON).into_owned());
            }
            said.push(format!("variant {}", cell.variant));
        } else {
            let answers = cell.answers.iter();
            said.extend(
                answers.map(|(answer, count)| format!("{count} \u{d7} {}", answer.label())),
            );
            if let (Some(name), Some(least)) = (colour, cell.least) {
                said.push(format!(
                    "least {name} {}",
                    crate::text::words::figure(least)
                ));
            }
            said.push(format!("first variant {}", cell.variant));
        }
        if in_page {
            said.push(self.command(cell));
        }
        let said: Vec<String> = said.iter().map(|line| escaped(line)).collect();
        said.join("\n")
    }

    /// What is told of cells of one colour beside one another.
    fn told_of_run(&self, first: usize, last: usize) -> String {
        let value = |index: usize, place: usize| {
            let cell = self.cells.get(index);
            cell.and_then(|cell| cell.measures.get(place - 1))
                .map_or("", String::as_str)
        };
        let (x, y) = (self.sweep.x, self.sweep.y);
        let shown = self.tone(first).map_or("", |tone| self.label(tone));
        escaped(&format!(
            "{} = {} … {}, {} = {}: {shown}",
            self.x_name(),
            value(first, x),
            value(last, x),
            self.y_name(),
            value(first, y),
        ))
    }

    /// The values of the measures: of all, or of those on the axes where several rows are one cell.
    fn values(&self, cell: &Cell) -> String {
        let sweep = &self.sweep;
        let is_shown = |place: usize| cell.rows() == 1 || place == sweep.x || place == sweep.y;
        let all: Vec<String> = sweep
            .columns
            .measures()
            .zip(&cell.measures)
            .filter(|(place, _)| is_shown(*place))
            .map(|(place, value)| format!("{} = {value}", sweep.columns.measure_name(place)))
            .collect();
        all.join(", ")
    }

    fn write_legend(&self, has_border: bool, svg: &mut String) {
        let left = PLOT[0] + 4.0;
        let words = left + SWATCH + 7.0;
        let things = match self.is_grid() {
            true => "cells",
            false => "points",
        };
        let column = self.sweep.colour_name().unwrap_or("answer");
        put(
            svg,
            format_args!(
                "<text class=\"title\" x=\"{}\" y=\"{}\">{}: {things}</text>\n",
                px(left),
                px(LEGEND_TOP - 8.0),
                escaped(&clipped(column, LONGEST_LABEL))
            ),
        );
        for (row, entry) in self.legend.iter().enumerate() {
            let top = LEGEND_TOP + LEGEND_ROW * row as f64;
            put(
                svg,
                format_args!(
                    "<g class=\"legend\"><rect class=\"cell swatch {}\" x=\"{}\" y=\"{}\" width=\"{s}\" height=\"{s}\"/><text x=\"{}\" y=\"{}\">{}: {}<title>{}</title></text></g>\n",
                    entry.class,
                    px(left),
                    px(top),
                    px(words),
                    px(top + 10.5),
                    escaped(&clipped(&entry.label, LONGEST_LABEL)),
                    entry.count,
                    escaped(&entry.label),
                    s = px(SWATCH),
                ),
            );
        }
        if has_border {
            let middle = LEGEND_TOP + LEGEND_ROW * self.legend.len() as f64 + 6.5;
            put(
                svg,
                format_args!(
                    "<g class=\"legend\"><path class=\"border\" d=\"M{} {}H{}\"/><text x=\"{}\" y=\"{}\">the answer changes</text></g>\n",
                    px(left),
                    px(middle),
                    px(left + SWATCH),
                    px(words),
                    px(middle + 4.0)
                ),
            );
        }
    }
}

/// Pixels of both axes of a plot.
fn rulers(plot: &Plot) -> Rulers {
    let [across, up] = plot.window();
    Rulers {
        x: Ruler {
            range: plot.x.drawn_range(),
            pixels: across,
        },
        y: Ruler {
            range: plot.y.drawn_range(),
            pixels: up,
        },
    }
}

fn write_border(border: &[Line], grid: Option<&Grid>, rulers: &Rulers, svg: &mut String) {
    let Some(grid) = grid.filter(|_| !border.is_empty()) else {
        return;
    };
    let mut path = String::new();
    for line in border {
        match *line {
            Line::Upright { column, from, to } => put(
                &mut path,
                format_args!(
                    "M{} {}V{}",
                    rulers.x.border(&grid.x, column),
                    rulers.y.border(&grid.y, from),
                    rulers.y.border(&grid.y, to)
                ),
            ),
            Line::Level { row, from, to } => put(
                &mut path,
                format_args!(
                    "M{} {}H{}",
                    rulers.x.border(&grid.x, from),
                    rulers.y.border(&grid.y, row),
                    rulers.x.border(&grid.x, to)
                ),
            ),
        }
    }
    put(svg, format_args!("<path class=\"border\" d=\"{path}\"/>\n"));
}

/// The frame again: cells cover half of it.
fn write_frame(rulers: &Rulers, svg: &mut String) {
    let ([left, right], [bottom, top]) = (rulers.x.pixels, rulers.y.pixels);
    let (top, bottom) = (px(top), px(bottom));
    put(
        svg,
        format_args!(
            "<path class=\"frame\" d=\"M{} {top}V{bottom}H{}V{top}Z\"/>\n",
            px(left),
            px(right)
        ),
    );
}

/// A sentence in lines of so many columns.
fn lines(sentence: &str, room: usize) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    for word in sentence.split_whitespace() {
        if !line.is_empty() && columns(&line) + 1 + columns(word) > room {
            lines.push(std::mem::take(&mut line));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    lines.push(line);
    lines
}
