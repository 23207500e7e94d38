//! Several charts below each other as one picture.

use maud::{PreEscaped, html};

use super::Chart;
use super::layout::Layout;
use crate::Error;

/// The SVG text of charts below each other, for a file; `title` is the text of the whole for screen readers.
///
/// # Errors
/// A chart that cannot be drawn.
pub fn stacked(title: &str, charts: &[Chart]) -> Result<String, Error> {
    let (mut width, mut height) = (0.0_f64, 0.0_f64);
    let mut content = String::new();
    for chart in charts {
        let layout = Layout::of(chart);
        let inner = chart.svg()?;
        let (_, inner) = inner.split_once("<svg ").unwrap_or_default();
        content += &format!("<svg y=\"{height}\" {inner}");
        width = width.max(layout.width.ceil());
        height += layout.height.ceil();
    }
    let svg = html! {
        svg xmlns="http://www.w3.org/2000/svg" class="chart" role="img" width=(width) height=(height)
            viewBox=(format!("0 0 {width} {height}")) {
            title { (title) }
            rect class="paper" width="100%" height="100%" fill="#FFFFFF" {}
            (PreEscaped(content))
        }
    };
    Ok(svg.into_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::samples;

    #[test]
    fn charts_stand_below_each_other() {
        let [(_, first), (_, second), ..] = samples();
        let heights = [&first, &second].map(|chart| Layout::of(chart).height.ceil());
        let picture = stacked("two", &[first, second]).unwrap();
        assert!(picture.contains("<svg y=\"0\"") && picture.contains(&format!("<svg y=\"{}\"", heights[0])));
        assert!(
            picture.starts_with("<svg ")
                && picture.contains(&format!("height=\"{}\" viewBox", heights[0] + heights[1]))
        );
        assert_eq!(picture.matches("</svg>").count(), 3);
    }
}
