//! Many cells as an image within the picture.

use std::io;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, html};

use super::shades::{MISSING, Shades};
use super::strip::Strip;
use crate::Error;
use crate::picture::elements::{Place, length};

/// From this number of cells in all panels on they are drawn as images; so are cells narrower than this.
pub(super) const TOO_MANY_RECTANGLES: usize = 10_000;
const NARROWEST: f64 = 2.0;

/// Pixels of the image for each unit of the picture, where cells have different sizes.
const FINENESS: f64 = 4.0;

/// Whether a picture of this number of cells on panels like this has images.
pub(super) fn is_needed(cells: usize, (columns, rows): (usize, usize), place: Place) -> bool {
    let narrowest = (place.width / columns as f64).min(place.height / rows as f64);
    cells >= TOO_MANY_RECTANGLES || narrowest < NARROWEST
}

/// Which cell each pixel along an axis shows, of this length.
pub(super) fn pixels(strip: &Strip, length: f64) -> Vec<usize> {
    let (borders, cells) = (&strip.borders, strip.count());
    if strip.is_even(0.05 / length) {
        return (0..cells).collect();
    }
    let pixels = (FINENESS * length).ceil() as usize;
    let middle = |pixel: usize| (pixel as f64 + 0.5) / pixels as f64;
    (0..pixels).map(|pixel| borders[1..cells].partition_point(|&border| border <= middle(pixel))).collect()
}

/// The cells of a panel. Those without a value are transparent; the numbers are row by row, from the lowest upwards.
pub(super) fn image(
    shades: &Shades<'_>,
    numbers: &[u8],
    (columns, (x, y)): (usize, (&[usize], &[usize])),
    place: Place,
) -> Result<Markup, Error> {
    // an image begins at the top
    let rows = y.iter().rev().map(|j| &numbers[j * columns..(j + 1) * columns]);
    let data: Vec<u8> = rows.flat_map(|row| x.iter().map(|&i| row[i])).collect();
    let encoded = png(shades, &data, (x.len() as u32, y.len() as u32)).map_err(io::Error::other)?;
    let address = format!("data:image/png;base64,{}", STANDARD.encode(encoded));
    // programs that do not know `pixelated` know the older attribute
    Ok(html! {
        image x=(length(place.left)) y=(length(place.top)) width=(length(place.width)) height=(length(place.height))
            preserveAspectRatio="none" image-rendering="optimizeSpeed" style="image-rendering:pixelated" href=(address) {}
    })
}

fn png(shades: &Shades<'_>, numbers: &[u8], (width, height): (u32, u32)) -> Result<Vec<u8>, png::EncodingError> {
    let mut encoded = Vec::new();
    let mut encoder = png::Encoder::new(&mut encoded, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette((0..=255).flat_map(|number| shades.rgb(number)).collect::<Vec<u8>>());
    encoder.set_trns((0..=255).map(|number| if number == MISSING { 0 } else { 255 }).collect::<Vec<u8>>());
    let mut writer = encoder.write_header()?;
    writer.write_image_data(numbers)?;
    writer.finish()?;
    Ok(encoded)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::heat_map::CellAxis;

    fn strip(values: &[f64]) -> Strip {
        Strip::of_x(&CellAxis::linear("", values.to_vec()))
    }

    #[test]
    fn cells_of_one_size_have_a_pixel_each() {
        assert_eq!(pixels(&strip(&[1.0, 2.0, 3.0, 4.0]), 400.0), [0, 1, 2, 3]);
    }

    /// The borders are where they should be, to half a pixel of the image.
    #[test]
    fn cells_of_different_sizes_have_pixels_by_their_sizes() {
        let strip = strip(&[0.0, 1.0, 11.0]);
        let pixels = pixels(&strip, 100.0);
        assert_eq!(pixels.len(), 400);
        for (cell, pair) in strip.borders.windows(2).enumerate() {
            let first = pixels.iter().position(|&of| of == cell).unwrap();
            assert!((first as f64 - 400.0 * pair[0]).abs() <= 0.5);
            let count = pixels.iter().filter(|&&of| of == cell).count();
            assert!((count as f64 - 400.0 * (pair[1] - pair[0])).abs() <= 1.0);
        }
    }
}
