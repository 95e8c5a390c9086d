//! The few colours of a picture that is stored by their numbers.

use std::collections::HashMap;

/// As many colours fit into a byte.
const MOST: usize = 256;

type Colour = [u8; 3];

/// The colours that pictures have most of. A drawing has few colours, and shades of them at its
/// edges, so that the frequent ones are exact and the others have one that is close.
pub(super) struct Palette {
    colours: Vec<Colour>,
}

impl Palette {
    /// The palette for pictures, each of which is three bytes a pixel.
    pub fn of(pictures: &[Vec<u8>]) -> Self {
        let mut counts: HashMap<Colour, usize> = HashMap::new();
        for colour in pictures.iter().flat_map(|picture| picture.as_chunks().0) {
            *counts.entry(*colour).or_default() += 1;
        }
        let mut counts: Vec<_> = counts.into_iter().collect();
        // colours that are as frequent in their own order, so that a picture has one palette
        counts.sort_unstable_by_key(|(colour, count)| (std::cmp::Reverse(*count), *colour));
        counts.truncate(MOST);
        Self { colours: counts.into_iter().map(|(colour, _)| colour).collect() }
    }

    pub fn bytes(&self) -> &[u8] {
        self.colours.as_flattened()
    }

    /// The number of the nearest colour for every pixel.
    pub fn indices(&self, picture: &[u8]) -> Vec<u8> {
        let mut known: HashMap<Colour, u8> = HashMap::new();
        let pixels = picture.as_chunks().0.iter();
        pixels.map(|colour| *known.entry(*colour).or_insert_with(|| self.nearest(*colour))).collect()
    }

    fn nearest(&self, colour: Colour) -> u8 {
        let apart = |other: &Colour| -> u32 {
            (0..3).map(|channel| u32::from(other[channel].abs_diff(colour[channel])).pow(2)).sum()
        };
        let numbered = (0..=u8::MAX).zip(&self.colours);
        numbered.min_by_key(|(_, other)| apart(other)).map_or(0, |(number, _)| number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_exact() {
        let picture: Vec<u8> = (0..200).flat_map(|k| [k, 255 - k, 7]).collect();
        let palette = Palette::of(std::slice::from_ref(&picture));
        let shown: Vec<u8> =
            palette.indices(&picture).iter().flat_map(|at| palette.colours[usize::from(*at)]).collect();
        assert_eq!(shown, picture);
    }

    #[test]
    fn rare_colours_among_many_are_near() {
        let shade = |k: u16| [(k % 256) as u8, (k / 256) as u8 * 255, 0];
        let mut picture: Vec<u8> = (0..512).flat_map(shade).collect();
        picture.extend([9, 255, 0].repeat(5));
        let palette = Palette::of(std::slice::from_ref(&picture));
        assert_eq!(palette.colours.len(), MOST);
        assert_eq!(palette.colours[0], [9, 255, 0], "the most frequent one");
        // 255 of the others have room, in their order: two with each red up to 127
        assert_eq!(palette.colours[usize::from(palette.nearest([255, 0, 0]))], [127, 0, 0]);
        assert_eq!(palette.colours[usize::from(palette.nearest([200, 255, 0]))], [127, 255, 0]);
    }
}
