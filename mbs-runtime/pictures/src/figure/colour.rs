//! Colours that people with colour vision deficiencies can tell apart.

use plotters::style::RGBColor;

/// The colours of curves, in order: Okabe and Ito's palette without yellow
/// (<https://jfly.uni-koeln.de/color/>).
pub const SERIES_COLOURS: [[u8; 3]; 7] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [60, 60, 60],
];

/// The colour of the `at`th curve; they repeat.
pub(super) fn series(at: usize) -> RGBColor {
    let [r, g, b] = SERIES_COLOURS.get(at % SERIES_COLOURS.len()).copied().unwrap_or_default();
    RGBColor(r, g, b)
}

/// Ten samples of the colour map viridis (CC0, Smith and van der Walt).
const VIRIDIS: [[u8; 3]; 10] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x28, 0x78],
    [0x3e, 0x49, 0x89],
    [0x31, 0x68, 0x8e],
    [0x26, 0x82, 0x8e],
    [0x1f, 0x9e, 0x89],
    [0x35, 0xb7, 0x79],
    [0x6e, 0xce, 0x58],
    [0xb5, 0xde, 0x2b],
    [0xfd, 0xe7, 0x25],
];

/// The colour of a fraction from 0 (dark) to 1 (bright), interpolated linearly.
pub fn colour_map(fraction: f64) -> [u8; 3] {
    let at = fraction.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let low = (at as usize).min(VIRIDIS.len() - 2);
    let part = at - low as f64;
    let mut mixed = [0; 3];
    for (channel, value) in mixed.iter_mut().enumerate() {
        let (a, b) = (f64::from(VIRIDIS[low][channel]), f64::from(VIRIDIS[low + 1][channel]));
        *value = (a + part * (b - a)).round() as u8;
    }
    mixed
}
