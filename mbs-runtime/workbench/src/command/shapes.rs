//! Mode shapes as pictures: the mechanism swings in a mode about its operating point.
//!
//! The mechanism moves along its constraints.

use std::f64::consts::TAU;

use mbs_analysis::{Mode, Variable};
use mbs_runtime::equations::{Room, project};

use crate::figure::{Figure, Panel};
use crate::number::significant;
use crate::picture::Extent;
use crate::report::Animation;
use crate::{Motion, Operating, Picture};

/// The largest amplitude of a point, as a share of the size of the mechanism.
const SWING: f64 = 0.12;
/// The largest amplitude of an angle, in rad.
const TURN: f64 = 0.35;
/// Frames of a period, and periods of an animation.
const FRAMES: usize = 40;
const PERIODS: usize = 4;
/// The period in which a mode is shown that does not oscillate, in s.
const PERIOD: f64 = 1.0;
/// Poses of a still picture: between the extremes.
const POSES: usize = 5;

/// Draws the modes of a mechanism about its operating point.
pub(super) struct Shapes<'a> {
    pub operating: &'a Operating<'a>,
    /// Positions of the coordinates that are states.
    pub independent: Vec<usize>,
}

impl<'a> Shapes<'a> {
    pub fn new(operating: &'a Operating<'a>, states: &[mbs_analysis::Signal]) -> Self {
        let place = |state: &mbs_analysis::Signal| match state.variable {
            Variable::Coordinate(at) => Some(at),
            _ => None,
        };
        Self { operating, independent: states.iter().filter_map(place).collect() }
    }

    /// Whether there is anything to draw.
    pub fn can_draw(&self) -> bool {
        !self.operating.run.sketch().points.is_empty()
    }

    /// The mechanism as it swings in a mode.
    pub fn animation(&self, mode: &Mode, title: String) -> Animation {
        let period = if mode.damped_frequency() > 0.0 { TAU / mode.damped_frequency() } else { PERIOD };
        let instants = 0..=FRAMES * PERIODS;
        let frames = instants.map(|k| (k as f64 / FRAMES as f64 * period, TAU * k as f64 / FRAMES as f64));
        Animation { title, picture: Picture::of(&self.motion(mode, frames)), readouts: Vec::new() }
    }

    /// All modes, each between its extremes.
    pub fn figure(&self, title: &str, modes: &[Mode], heading: impl Fn(usize) -> String) -> Figure {
        let picture = |mode: &Mode| {
            let half = (0..POSES).map(|k| k as f64 / (POSES - 1) as f64);
            Picture::of(&self.motion(mode, half.map(|share| (share, 0.5 * TAU * share))))
        };
        let mut figure = Figure::new(title);
        let mut height = 0;
        for (at, mode) in modes.iter().enumerate() {
            let picture = picture(mode);
            height = height.max(Figure::mechanism("", picture.clone()).panel_height);
            let mut panel = Panel::mechanism(picture);
            panel.x.label = format!("{},  x", heading(at));
            figure = figure.panel(panel);
        }
        figure.panel_height(height)
    }

    /// Times and phases of a motion in a mode.
    fn motion(&self, mode: &Mode, frames: impl Iterator<Item = (f64, f64)>) -> Motion {
        let size = self.size(mode);
        let (times, phases): (Vec<f64>, Vec<f64>) = frames.unzip();
        let places = phases.iter().map(|phase| self.places(&self.position(mode, size, *phase))).collect();
        Motion { sketch: self.operating.model.sketch(), times, places }
    }

    /// Re(φ e^{iφ₀}) on the constraints, which keep what is rigid rigid; beside them if it leads too far.
    fn position(&self, mode: &Mode, size: f64, phase: f64) -> Vec<f64> {
        let point = &self.operating.point;
        let (sin, cos) = phase.sin_cos();
        let moved = point.q.iter().zip(mode.shape.iter());
        let linear: Vec<f64> = moved.map(|(q, shape)| q + size * (shape.re * cos - shape.im * sin)).collect();
        let info = self.operating.info();
        let keep: Vec<&'static str> = self.independent.iter().map(|at| info.coordinates[*at].name).collect();
        let (mut q, mut v) = (linear.clone(), vec![0.0; linear.len()]);
        let mut numbers = vec![0.0; Room::<f64>::len(info, 0)];
        let mut room = Room::within(&mut numbers, info);
        match project(self.operating.run.equations(), point.t, &mut q, &mut v, [&keep, &[]], &mut room) {
            Ok(()) => q,
            Err(_) => linear,
        }
    }

    fn places(&self, q: &[f64]) -> Vec<[f64; 2]> {
        let run = &self.operating.run;
        let mut points = vec![0.0; 2 * run.sketch().points.len()];
        run.points(self.operating.point.t, q, &mut points);
        points.chunks_exact(2).map(|point| [point[0], point[1]]).collect()
    }

    /// How large a shape is drawn.
    fn size(&self, mode: &Mode) -> f64 {
        const SMALL: f64 = 1e-4;
        let point = &self.operating.point;
        let here = self.places(&point.q);
        let moved = |part: fn(f64, f64) -> f64| {
            let q = point.q.iter().zip(mode.shape.iter());
            let there =
                self.places(&q.map(|(q, shape)| q + SMALL * part(shape.re, shape.im)).collect::<Vec<_>>());
            let distances = here.iter().zip(&there).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]) / SMALL);
            distances.fold(0.0, f64::max)
        };
        let farthest = moved(|re, _| re).max(moved(|_, im| im));
        let info = self.operating.info();
        let angles = info
            .coordinates
            .iter()
            .take(info.lines)
            .zip(mode.shape.iter())
            .filter(|(q, _)| q.dimension.length == 0);
        let turned = angles.map(|(_, shape)| shape.norm()).fold(0.0, f64::max);
        let still = Motion { sketch: self.operating.model.sketch(), times: vec![0.0], places: vec![here] };
        let Extent { low, high } = Picture::of(&still).extent();
        let span = (high[0] - low[0]).max(high[1] - low[1]);
        let by = |most: f64, of: f64| if of > 0.0 { most / of } else { f64::INFINITY };
        let size = by(SWING * span, farthest).min(by(TURN, turned));
        if size.is_finite() { size } else { 0.0 }
    }
}

/// The title of a mode: its number, and its frequency or its behaviour.
pub(super) fn title(at: usize, mode: &Mode) -> String {
    let number = at + 1;
    if mode.damped_frequency() > 0.0 {
        let hertz = significant(mode.damped_frequency() / TAU, 4);
        let ratio = mode.damping_ratio().filter(|ratio| *ratio != 0.0);
        let damping = ratio.map_or_else(String::new, |ratio| format!(", ζ = {}", significant(ratio, 3)));
        return format!("mode {number}: {hertz} Hz{damping}");
    }
    format!("mode {number}: {}", mode.behaviour.words())
}
