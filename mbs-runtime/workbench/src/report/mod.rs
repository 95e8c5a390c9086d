//! Reports: one HTML file that shows everything, offline, without a server.

mod animation;
mod data;

use std::path::Path;

pub use animation::{Animation, Readout};

use crate::figure::{Content, Figure};
use crate::{Error, Table};

const PAGE: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");
const SHAPES_SCRIPT: &str = include_str!("mechanism.js");
const UPLOT_STYLE: &str = include_str!("../../assets/uplot/uPlot.min.css");
const UPLOT_SCRIPT: &str = include_str!("../../assets/uplot/uPlot.iife.min.js");

/// A report: a title, an introduction and sections.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// The title.
    pub title: String,
    /// What it is about, in a paragraph.
    pub lead: String,
    /// The sections, in order.
    pub sections: Vec<Section>,
}

/// A section of a report.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Its heading.
    pub heading: String,
    /// Its contents, in order.
    pub blocks: Vec<Block>,
}

/// A part of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A paragraph of plain text.
    Text(String),
    /// A figure: curves can be zoomed and read off, maps are pictures.
    Figure {
        /// The figure.
        figure: Figure,
        /// What it shows.
        caption: String,
        /// Files with the same content, to be linked.
        files: Vec<String>,
    },
    /// A table.
    Table(Table),
    /// A moving picture of a mechanism.
    Animation(Animation),
}

impl Section {
    /// An empty section.
    pub fn new(heading: impl Into<String>) -> Self {
        Self { heading: heading.into(), blocks: Vec::new() }
    }

    /// With one more block.
    #[must_use]
    pub fn with(mut self, block: Block) -> Self {
        self.blocks.push(block);
        self
    }

    /// With one more paragraph.
    #[must_use]
    pub fn text(self, text: impl Into<String>) -> Self {
        self.with(Block::Text(text.into()))
    }
}

impl Report {
    /// The report as one HTML page without references to anything outside it,
    /// except links to the files that figures name.
    ///
    /// # Errors
    /// [`Error::Figure`] if a picture cannot be drawn.
    pub fn html(&self) -> Result<String, Error> {
        let mut plots = Vec::new();
        let mut body = String::new();
        for (number, section) in self.sections.iter().enumerate() {
            body += &format!("<section id=\"s{number}\">\n<h2>{}</h2>\n", escaped(&section.heading));
            for block in &section.blocks {
                body += &self::block(block, &mut plots)?;
            }
            body += "</section>\n";
        }
        let contents =
            self.sections.iter().enumerate().map(|(number, section)| {
                format!("<a href=\"#s{number}\">{}</a>\n", escaped(&section.heading))
            });
        // `</` would end the script element in the middle of the data.
        let data = serde_json::Value::Array(plots).to_string().replace("</", "<\\/");
        let page = PAGE
            .replace("@TITLE@", &escaped(&self.title))
            .replace("@LEAD@", &escaped(&self.lead))
            .replace("@CONTENTS@", &contents.collect::<String>())
            .replace("@STYLE@", &format!("{UPLOT_STYLE}\n{STYLE}"))
            .replace("@SCRIPT@", &format!("{UPLOT_SCRIPT}\n{SHAPES_SCRIPT}\n{SCRIPT}"));
        Ok(page.replace("@BODY@", &body).replace("@DATA@", &data))
    }

    /// Writes the page to a file.
    ///
    /// # Errors
    /// [`Error::Figure`], [`Error::File`].
    pub fn save(&self, path: &Path) -> Result<(), Error> {
        std::fs::write(path, self.html()?).map_err(Error::file("write", path))
    }
}

fn block(block: &Block, plots: &mut Vec<serde_json::Value>) -> Result<String, Error> {
    Ok(match block {
        Block::Text(text) => format!("<p>{}</p>\n", escaped(text)),
        Block::Table(table) => html_table(table),
        Block::Animation(animation) => {
            plots.push(animation.data());
            format!("<figure class=\"animation\" data-plot=\"{}\"></figure>\n", plots.len() - 1)
        }
        Block::Figure { figure, caption, files } => html_figure(figure, caption, files, plots)?,
    })
}

fn html_figure(
    figure: &Figure,
    caption: &str,
    files: &[String],
    plots: &mut Vec<serde_json::Value>,
) -> Result<String, Error> {
    let mut html = String::from("<figure>\n");
    if figure.panels.iter().any(|panel| !matches!(panel.content, Content::Lines(_))) {
        let svg = figure.svg()?;
        // Only the element itself: an XML declaration has no place inside a page.
        html += svg.find("<svg").map_or("", |at| &svg[at..]);
        html += "\n";
    } else {
        // The picture of a map has the title in it.
        html += &format!("<h3>{}</h3>\n", escaped(&figure.title));
        for panel in &figure.panels {
            plots.push(data::panel(panel));
            html += &format!("<div class=\"plot\" data-plot=\"{}\"></div>\n", plots.len() - 1);
        }
    }
    let links = files.iter().map(|file| {
        let ending = file.rsplit('.').next().unwrap_or("file").to_uppercase();
        format!(" <a href=\"{}\">{}</a>", escaped(file), escaped(&ending))
    });
    html += &format!("<figcaption>{}{}</figcaption>\n", escaped(caption), links.collect::<String>());
    Ok(html + "</figure>\n")
}

fn html_table(table: &Table) -> String {
    let line = |cells: &[String], tag: &str| {
        let cells = cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell)));
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let rows = table.rows().iter().map(|row| line(row, "td"));
    format!(
        "<div class=\"scroll\"><table>\n<thead>{}</thead>\n<tbody>\n{}</tbody>\n</table></div>\n",
        line(table.headings(), "th"),
        rows.collect::<String>()
    )
}

/// Text as it has to be written in HTML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::{Axis, Panel, Series};

    #[test]
    fn a_page_that_needs_nothing_else() {
        let series = Series::new("</script>", [[0.0, 1e-8], [1.0, f64::NAN]]);
        let panel = Panel::lines(Axis::new("t", "s"), Axis::new("y", ""), [series]);
        let mut table = Table::new(["a < b"]);
        table.row(["1 & 2"]);
        let report = Report {
            title: "Test".into(),
            lead: "What it is.".into(),
            sections: vec![Section::new("One").text("Text.").with(Block::Table(table)).with(Block::Figure {
                figure: Figure::new("F").panel(panel),
                caption: "c".into(),
                files: vec!["f.csv".into()],
            })],
        };
        let html = report.html().unwrap();
        assert!(html.contains("a &lt; b") && html.contains("1 &amp; 2") && html.contains("f.csv"));
        assert!(html.contains("<\\/script>") && html.contains("1e-8") && html.contains("null"));
        assert!(!html.contains("@BODY@") && !html.contains("@DATA@"));
        assert!(!html.contains("src=\"http") && !html.contains("href=\"http"));
    }
}
