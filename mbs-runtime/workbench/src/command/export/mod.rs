//! `mbs export`: a mechanism as a program in another language, for other programs, or as a picture.
//!
//! Pictures are made of the shapes of a `Picture`, as figures are. DXF shows them at one instant. An SVG
//! carries the motion in its elements. A GIF has frames that are drawn as figures are. DXF and SVG need no
//! library.

mod c;
mod dxf;
mod fmu;
mod motion;
mod page;
mod svg;

use clap::{Args, Subcommand};

use crate::{Error, Model, Models, RunOptions, Settings};

#[derive(Args)]
#[command(
    about = "Write a mechanism as a program, for another program, as a page in which it runs, or as a drawing"
)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    target: Target,
}

#[derive(Subcommand)]
enum Target {
    C(c::Arguments),
    Fmu(fmu::Arguments),
    Page(page::Arguments),
    Dxf(dxf::Arguments),
    #[command(about = motion::SVG.about, after_help = motion::SVG.examples, mut_args(motion::SVG.ends()))]
    Svg(motion::Arguments),
    #[command(about = motion::GIF.about, after_help = motion::GIF.examples, mut_args(motion::GIF.ends()))]
    Gif(motion::Arguments),
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<(), Error> {
        match &self.target {
            Target::C(target) => target.run(models),
            Target::Fmu(target) => target.run(models),
            Target::Page(target) => target.run(models),
            Target::Dxf(target) => target.run(models),
            Target::Svg(target) => target.run(&motion::SVG, models),
            Target::Gif(target) => target.run(&motion::GIF, models),
        }
    }
}

/// The settings of a run with these options, and the step and the end that are asked for.
fn settings(
    model: &dyn Model,
    mut options: RunOptions,
    step: Option<&String>,
    end: Option<&String>,
) -> Result<Settings, Error> {
    for (name, text) in [("step", step), ("end", end)] {
        text.map_or(Ok(()), |text| options.set(name, text))?;
    }
    options.settings(model)
}
