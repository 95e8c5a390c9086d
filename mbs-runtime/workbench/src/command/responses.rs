//! Frequency and step responses: as curves, as columns and as tables.

use std::f64::consts::TAU;

use mbs_analysis::nalgebra::Complex;
use mbs_analysis::{Behaviour, Linearization, Mode, phases};
use mbs_runtime::Info;

use crate::figure::axis;
use crate::figure::{Axis, Figure, Panel, SERIES_COLOURS, Series};
use crate::number::significant;
use crate::{Column, Error, Table, Unit};

/// Curves of one panel: as many as there are colours.
const MOST: usize = SERIES_COLOURS.len();
/// Frequencies, evenly spread over the decades.
const FREQUENCIES: usize = 400;
/// Instants of a step response.
const STEPS: usize = 1000;

/// An output per unit of an input.
struct Pair {
    name: String,
    unit: String,
    /// SI values per value in that unit.
    scale: f64,
    output: usize,
    input: usize,
}

fn pairs(info: &Info, linear: &Linearization) -> Vec<Pair> {
    let pair = |(output, input): (usize, usize)| {
        let (y, u) = (&linear.outputs[output], &linear.inputs[input]);
        let (of_y, of_u) = (Unit::of_signal(info, y), Unit::of_signal(info, u));
        let name = format!("{} per {}", y.name, u.name);
        Pair { name, unit: ratio(&of_y, &of_u), scale: of_y.read(1.0) / of_u.read(1.0), output, input }
    };
    let inputs = 0..linear.inputs.len();
    inputs.flat_map(|input| (0..linear.outputs.len()).map(move |output| (output, input))).map(pair).collect()
}

/// `mm/N`, `rad/(N*m)`, `1/N`.
pub(super) fn ratio(over: &Unit, under: &Unit) -> String {
    let has_parts = under.name().contains(['*', '/']);
    match (over.name(), under.name()) {
        (over, "") => over.to_owned(),
        (over, under) => {
            let over = if over.is_empty() { "1" } else { over };
            if has_parts { format!("{over}/({under})") } else { format!("{over}/{under}") }
        }
    }
}

/// Positions of pairs in groups of one unit, as many to a group as a panel has colours; without those that
/// do not answer at all.
fn groups(pairs: &[Pair], answers: impl Fn(usize) -> bool) -> Vec<(&str, Vec<usize>)> {
    let mut groups: Vec<(&str, Vec<usize>)> = Vec::new();
    for (at, pair) in pairs.iter().enumerate().filter(|(at, _)| answers(*at)) {
        match groups.iter_mut().find(|(unit, list)| *unit == pair.unit && list.len() < MOST) {
            Some((_, list)) => list.push(at),
            None => groups.push((&pair.unit, vec![at])),
        }
    }
    groups
}

/// The frequency response of every pair.
pub(super) struct Bode {
    pairs: Vec<Pair>,
    /// In Hz, ascending.
    frequencies: Vec<f64>,
    /// H in SI units, for every pair at every frequency.
    responses: Vec<Vec<Complex<f64>>>,
    /// Where each is largest in Hz, and how large: infinite at an undamped mode.
    peaks: Vec<[f64; 2]>,
    /// The frequencies of undamped modes in Hz, at which responses have no value.
    resonances: Vec<f64>,
    is_unstable: bool,
}

impl Bode {
    /// Over a range in Hz, or over that of the modes.
    pub fn of(info: &Info, linear: &Linearization, range: Option<[f64; 2]>) -> Result<Self, Error> {
        let modes = linear.modes()?;
        let [low, high] = range.unwrap_or_else(|| usual_range(&modes));
        let frequencies = frequencies(low, high, &modes);
        let undamped = modes.iter().filter(|mode| mode.behaviour == Behaviour::Undamped);
        let resonances: Vec<f64> = undamped
            .map(|mode| mode.damped_frequency() / TAU)
            .filter(|hertz| (low..=high).contains(hertz))
            .collect();
        let pairs = pairs(info, linear);
        let mut responses: Vec<Vec<Complex<f64>>> = pairs.iter().map(|_| Vec::new()).collect();
        for hertz in &frequencies {
            let found = linear.frequency_response(TAU * hertz)?;
            let is_resonance = resonances.contains(hertz);
            for (pair, list) in pairs.iter().zip(&mut responses) {
                let h = found[(pair.output, pair.input)];
                list.push(if is_resonance { Complex::new(f64::NAN, f64::NAN) } else { h });
            }
        }
        let mut found = Self {
            peaks: Vec::new(),
            resonances,
            is_unstable: modes.iter().any(|mode| mode.behaviour.is_unstable()),
            pairs,
            frequencies,
            responses,
        };
        found.peaks = (0..found.pairs.len()).map(|at| found.peak(linear, at)).collect::<Result<_, _>>()?;
        Ok(found)
    }

    /// Where the response of a pair is largest in Hz, and how large it is there: between the neighbours of the
    /// largest value that was computed, or at an undamped mode that the pair sees.
    fn peak(&self, linear: &Linearization, pair: usize) -> Result<[f64; 2], Error> {
        let Pair { output, input, .. } = self.pairs[pair];
        let of = |hertz: f64| Ok::<_, Error>(linear.frequency_response(TAU * hertz)?[(output, input)].norm());
        for hertz in &self.resonances {
            // near a pole it grows as the distance falls, by a factor of 100
            if of(hertz * (1.0 + 1e-6))? > 10.0 * of(hertz * (1.0 + 1e-4))? {
                return Ok([*hertz, f64::INFINITY]);
            }
        }
        let sizes = self.responses[pair].iter().map(|h| h.norm()).enumerate();
        let known = sizes.filter(|(_, size)| size.is_finite());
        let (at, size) = known.fold((0, 0.0), |best, here| if here.1 > best.1 { here } else { best });
        if at == 0 || at + 1 == self.frequencies.len() || size == 0.0 {
            return Ok([self.frequencies[at], size]);
        }
        let (mut low, mut high) = (self.frequencies[at - 1], self.frequencies[at + 1]);
        // thirds, until half of the digits of the frequency are known: so flat is a maximum
        for _ in 0..50 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if of(a)? < of(b)? { low = a } else { high = b }
        }
        let hertz = 0.5 * (low + high);
        Ok([hertz, of(hertz)?])
    }

    /// The phases of a pair in degrees.
    fn phases(&self, pair: usize) -> Vec<f64> {
        let found = phases(&self.frequencies, &self.responses[pair], &self.resonances);
        found.into_iter().map(f64::to_degrees).collect()
    }

    /// Magnitudes, a panel for each unit, and phases.
    pub fn figure(&self, title: &str) -> Figure {
        let frequency = || Axis::new("frequency", "Hz").log();
        let mut figure = Figure::new(title).panel_height(330);
        for (unit, list) in groups(&self.pairs, |at| self.peaks[at][1] > 0.0) {
            let name = |at: usize| self.pairs[at].name.replace('_', " ");
            let finite = |x: f64| if x.is_finite() && x > 0.0 { x } else { f64::NAN };
            let magnitude = |at: usize| {
                let sizes = self.responses[at].iter().map(|h| finite(h.norm() / self.pairs[at].scale));
                Series::new(name(at), self.frequencies.iter().copied().zip(sizes).map(|(f, y)| [f, y]))
            };
            let phase = |at: usize| Series::xy(name(at), &self.frequencies, &self.phases(at));
            let phases: Vec<Series> = list.iter().map(|at| phase(*at)).collect();
            let [low, high] = turns(&phases);
            let degrees = Axis::new("phase", "°").range(low, high).ticks_of(90.0);
            figure = figure
                .panel(Panel::lines(
                    frequency(),
                    axis("magnitude", unit).log(),
                    list.iter().map(|at| magnitude(*at)),
                ))
                .panel(Panel::lines(frequency(), degrees, phases));
        }
        figure
    }

    /// Frequency, and magnitude and phase of every pair.
    pub fn columns(&self) -> Vec<Column> {
        let column = |name: &str, unit: &str, values: Vec<f64>| {
            let mut column = Column::new(name, unit);
            column.values = values;
            column
        };
        let mut columns = vec![column("frequency", "Hz", self.frequencies.clone())];
        for (at, pair) in self.pairs.iter().enumerate() {
            let magnitudes = self.responses[at].iter().map(|h| h.norm() / pair.scale).collect();
            columns.push(column(&format!("|{}|", pair.name), &pair.unit, magnitudes));
            columns.push(column(&format!("phase({})", pair.name), "deg", self.phases(at)));
        }
        columns
    }

    /// The ends of the range, and where every response is largest.
    pub fn table(&self, title: &str) -> Table {
        let ends = [self.frequencies.first(), self.frequencies.last()];
        let [low, high] = ends.map(|end| format!("at {} Hz", significant(end.copied().unwrap_or(0.0), 4)));
        let mut table = Table::new([title, &low, &high, "largest", "there", "unit"]);
        for (at, pair) in self.pairs.iter().enumerate() {
            let shown = |si: f64| significant(si / pair.scale, 5);
            let list = &self.responses[at];
            let end = |h: Option<&Complex<f64>>| h.map_or_else(String::new, |h| shown(h.norm()));
            let [hertz, size] = self.peaks[at];
            let largest = if size.is_infinite() { "∞ (undamped)".into() } else { shown(size) };
            let place = if size > 0.0 { format!("{} Hz", significant(hertz, 5)) } else { "–".into() };
            table.row([
                pair.name.clone(),
                end(list.first()),
                end(list.last()),
                largest,
                place,
                pair.unit.clone(),
            ]);
        }
        table
    }

    /// The reason why a test does not show the response, if there is one.
    pub fn remark(&self) -> Option<&'static str> {
        self.is_unstable.then_some(
            "the system is unstable there: what grows hides this response, unless feedback holds it",
        )
    }
}

/// Half a decade and more around the modes; four decades around 1 Hz where nothing oscillates or decays.
fn usual_range(modes: &[Mode]) -> [f64; 2] {
    let rates = || modes.iter().map(|mode| mode.natural_frequency() / TAU).filter(|rate| *rate > 0.0);
    let (low, high) = (rates().fold(f64::INFINITY, f64::min), rates().fold(0.0, f64::max));
    if high == 0.0 {
        return [0.01, 100.0];
    }
    // at 1, 2 or 5 times a power of ten
    let round = |x: f64, up: bool| {
        let power = 10.0_f64.powf(x.log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
        let found =
            if up { steps.into_iter().find(|y| *y >= x) } else { steps.into_iter().rfind(|y| *y <= x) };
        found.unwrap_or(x)
    };
    [round(0.1 * low, false), round(10.0 * high, true)]
}

/// Evenly over the decades, and denser where a mode resonates; the frequency of an undamped one is among them.
fn frequencies(low: f64, high: f64, modes: &[Mode]) -> Vec<f64> {
    /// Of distances from a resonance.
    const PER_DECADE: i32 = 8;
    let mut list: Vec<f64> =
        (0..=FREQUENCIES).map(|k| low * (high / low).powf(k as f64 / FREQUENCIES as f64)).collect();
    for mode in modes.iter().filter(|mode| mode.damped_frequency() > 0.0) {
        let hertz = mode.damped_frequency() / TAU;
        // a peak without bound is drawn up to some hundred times its feet
        let width = mode.damping_ratio().filter(|ratio| *ratio != 0.0).map_or(0.02, f64::abs).max(1e-4);
        let closest = (PER_DECADE as f64 * (0.1 * width).log10()) as i32;
        let distances = (closest..0).map(|k| 10.0_f64.powf(f64::from(k) / f64::from(PER_DECADE)));
        list.extend(distances.flat_map(|share| [hertz * (1.0 - share), hertz * (1.0 + share)]));
        list.push(hertz);
    }
    list.retain(|hertz| (low..=high).contains(hertz));
    list.sort_by(f64::total_cmp);
    list.dedup();
    list
}

/// Quarters of a turn that hold some phases, in degrees.
fn turns(phases: &[Series]) -> [f64; 2] {
    let values =
        || phases.iter().flat_map(|phase| phase.points.iter()).map(|p| p[1]).filter(|y| y.is_finite());
    let (low, high) = values().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| (l.min(y), h.max(y)));
    if low > high {
        return [-180.0, 0.0];
    }
    // what is a quarter of a turn but for rounding is that
    let (low, high) = (90.0 * ((low + 1e-3) / 90.0).floor(), 90.0 * ((high - 1e-3) / 90.0).ceil());
    [low - 10.0, high.max(low + 90.0) + 10.0]
}

/// The responses to a unit step of every input.
pub(super) struct Steps {
    pairs: Vec<Pair>,
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
}

impl Steps {
    /// Until some time in s, or as long as the modes take.
    pub fn of(info: &Info, linear: &Linearization, end: Option<f64>) -> Result<Self, Error> {
        let end = match end {
            Some(end) => end,
            None => usual_end(&linear.modes()?),
        };
        let pairs = pairs(info, linear);
        let (mut times, mut values) = (Vec::new(), vec![Vec::new(); pairs.len()]);
        for (input, signal) in linear.inputs.iter().enumerate() {
            let found = linear.step_response(&signal.name, end, STEPS)?;
            for (pair, list) in pairs.iter().zip(&mut values).filter(|(pair, _)| pair.input == input) {
                *list = found.outputs.column(pair.output).iter().map(|y| y / pair.scale).collect();
            }
            times = found.times;
        }
        Ok(Self { pairs, times, values })
    }

    /// A panel for each unit.
    pub fn figure(&self, title: &str) -> Figure {
        let mut figure = Figure::new(title).panel_height(330);
        for (unit, list) in groups(&self.pairs, |at| self.values[at].iter().any(|y| *y != 0.0)) {
            let curve = |at: &usize| {
                Series::xy(self.pairs[*at].name.replace('_', " "), &self.times, &self.values[*at])
            };
            let y = axis("step response", unit);
            figure = figure.panel(Panel::lines(Axis::new("time", "s"), y, list.iter().map(curve)));
        }
        figure
    }

    /// Time, and every response.
    pub fn columns(&self) -> Vec<Column> {
        let mut time = Column::new("t", "s");
        time.values.clone_from(&self.times);
        let of_pairs = self.pairs.iter().zip(&self.values).map(|(pair, values)| {
            let mut column = Column::new(pair.name.clone(), &pair.unit);
            column.values.clone_from(values);
            column
        });
        std::iter::once(time).chain(of_pairs).collect()
    }
}

/// Five time constants of what decays most slowly, but no more than some ten periods of what oscillates most
/// slowly, and three time constants of what grows fastest.
fn usual_end(modes: &[Mode]) -> f64 {
    let least = |times: &mut dyn Iterator<Item = f64>| times.fold(f64::INFINITY, f64::min);
    let most = |times: &mut dyn Iterator<Item = f64>| times.fold(0.0, f64::max);
    let decays = modes.iter().filter(|mode| mode.eigenvalue.re < 0.0);
    let decayed = most(&mut decays.map(|mode| 5.0 * mode.time_constant()));
    let periods = modes.iter().filter(|mode| mode.damped_frequency() > 0.0);
    let slowest = most(&mut periods.map(|mode| TAU / mode.damped_frequency()));
    let grown = least(
        &mut modes.iter().filter(|mode| mode.behaviour.is_unstable()).map(|mode| 3.0 * mode.time_constant()),
    );
    let end = match (decayed > 0.0, slowest > 0.0) {
        (true, true) => decayed.clamp(2.0 * slowest, 12.0 * slowest),
        (true, false) => decayed,
        (false, true) => 10.0 * slowest,
        (false, false) => 1.0,
    };
    // two digits, so that axes end at round numbers
    let end = end.min(grown);
    let digit = 10.0_f64.powf(end.log10().floor() - 1.0);
    (end / digit).ceil() * digit
}
