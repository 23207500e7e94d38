use super::*;

/// Evenly spaced numbers from a to b.
fn even(a: f64, b: f64, count: usize) -> Vec<f64> {
    (0..count).map(|n| a + (b - a) * n as f64 / (count - 1).max(1) as f64).collect()
}

/// The same by their logarithms.
fn decades(a: f64, b: f64, count: usize) -> Vec<f64> {
    even(a.log10(), b.log10(), count).into_iter().map(|log10| 10f64.powf(log10)).collect()
}

/// The cells of a function of x and y.
fn cells(x: &[f64], y: &[f64], value: impl Fn(f64, f64) -> f64) -> Vec<Option<f64>> {
    let all = y.iter().flat_map(|&y| x.iter().map(move |&x| (x, y)));
    all.map(|(x, y)| Some(value(x, y)).filter(|value| !value.is_nan())).collect()
}

fn words(words: &[&str]) -> Vec<String> {
    words.iter().map(|&word| word.to_owned()).collect()
}

/// Cells row by row, each with the number of its word.
fn of_words(title: &str, cells: impl IntoIterator<Item = Option<usize>>) -> Panel {
    Panel::new(title, cells.into_iter().map(|cell| cell.map(|word| word as f64)).collect())
}

/// Drifts of three schemes, of which some runs failed and some conserve the energy to the last digit.
fn schemes() -> HeatMap {
    let (h, e) = (decades(0.01, 0.1, 19), even(0.05, 0.9, 18));
    let drift = |order: i32| {
        cells(&h, &e, move |h, e| match (h / (1.0 - e).powf(1.5)).powi(order) {
            drift if drift > 3.0 => f64::NAN,
            drift if drift < 1e-13 => 0.0,
            drift => 1e-2 * drift,
        })
    };
    let panel = |(name, order)| Panel::new(name, drift(order));
    let panels = [("Störmer–Verlet", 2), ("Yoshida 4", 4), ("Blanes–Moan SRKN 11, order 6", 8)].map(panel).to_vec();
    HeatMap {
        notes: vec!["A hundred periods; exact weights, double precision.".to_owned()],
        ..HeatMap::new(
            "Permanent change of the modified energy, Kepler's problem",
            CellAxis::logarithmic("step size h", h),
            CellAxis::linear("eccentricity e", e),
            Colour::logarithmic("permanent change of H̄ / |H|"),
            panels,
        )
    }
}

/// Escape times of points under the Hénon map, 300 × 300.
fn escapes(count: usize) -> HeatMap {
    let (x, y) = (even(-2.0, 2.0, count), even(-2.0, 2.0, count));
    let escape = |x0: f64, y0: f64| {
        let (mut x, mut y) = (x0, y0);
        (0..200).find(|_| {
            (x, y) = (1.0 - 1.25 * x * x + y, 0.3 * x);
            x * x + y * y > 100.0
        })
    };
    let time = |x: f64, y: f64| escape(x, y).map_or(f64::INFINITY, |n| f64::from(n + 1));
    let panels = vec![Panel::new("", cells(&x, &y, time))];
    HeatMap::new(
        "Escape of the Hénon map",
        CellAxis::linear("x", x),
        CellAxis::linear("y", y),
        Colour::linear("escape time (iterations)"),
        panels,
    )
}

/// Verdicts of several schemes, which are words.
fn verdicts() -> HeatMap {
    let schemes = ["Störmer–Verlet", "Ruth 3", "Yoshida 4", "Forest–Ruth", "McLachlan 4", "Blanes–Moan 6"];
    let h = [0.4, 0.2, 0.1, 0.05, 0.025, 0.0125];
    let found = |i: usize, j: usize| match i * 3 + j * 2 {
        0..=4 => Some(3),
        5..=8 => Some(2),
        9..=10 => Some(1),
        11 => None,
        12..=15 => Some(0),
        _ => Some(4),
    };
    let cells = (0..6).flat_map(|j| (0..6).map(move |i| found(i, j)));
    HeatMap::new(
        "Verdicts on the step size",
        CellAxis::logarithmic("step size h", h.to_vec()),
        CellAxis::words("scheme", words(&schemes)),
        Colour::words("verdict", words(&["fine", "near a resonance", "drifts", "too large", "undecided"])),
        vec![of_words("", cells)],
    )
}

/// Energy errors of both signs.
fn signed(colour: Colour) -> HeatMap {
    let (x, y) = (even(-1.0, 1.0, 40), even(-1.0, 1.0, 30));
    let cells = cells(&x, &y, |x, y| (x * y).powi(5) * 10f64.powf(6.0 * (x + y) - 3.0) + 1e-14 * x);
    let (x, y) = (CellAxis::linear("q_0", x), CellAxis::linear("p_0", y));
    HeatMap::new("Energy error after 10⁴ steps", x, y, colour, vec![Panel::new("", cells)])
}

/// Pictures of many kinds with their names. Axes of any kind in any role are drawn by `sweeps`.
fn samples() -> Vec<(&'static str, HeatMap)> {
    let many = HeatMap {
        panels: (1..=7).map(|n| Panel::new(format!("{n} planets"), schemes().panels[n % 3].cells.clone())).collect(),
        ..schemes()
    };
    let map = verdicts();
    let tilted = HeatMap { x: map.y.clone(), y: map.x.clone(), panels: vec![map.panels[0].clone(); 3], ..map };
    vec![
        ("schemes", schemes()),
        ("escapes", escapes(300)),
        ("verdicts", verdicts()),
        ("signed", signed(Colour::linear("ΔH"))),
        ("symmetric", signed(Colour::automatic("ΔH"))),
        ("tilted-words", tilted),
        ("many-panels", many),
    ]
}

/// `SHADOWSTEP_LOOK=DIR` keeps the pictures, for inspection.
#[test]
fn samples_are_drawn_whole() {
    let folder = std::env::var_os("SHADOWSTEP_LOOK");
    let large = folder.is_some().then(|| ("large", escapes(1500)));
    for (name, map) in samples().into_iter().chain(large) {
        let svg = map.svg().unwrap();
        if let Some(folder) = &folder {
            std::fs::write(std::path::Path::new(folder).join(format!("{name}.svg")), &svg).unwrap();
        }
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>"), "{name}");
        // one page contains many, so that ids would clash
        let drawn = without_images(&svg);
        for wrong in [" id=", "<script", "NaN", "inf", "url("] {
            assert!(!drawn.contains(wrong), "{name} has {wrong}");
        }
    }
}

fn without_images(svg: &str) -> String {
    let mut parts = svg.split("base64,");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |all, part| all + part.split_once('"').map_or("", |(_, rest)| rest))
}

/// The numbers in the paths of a colour, as lists.
fn paths(svg: &str, fill: &str) -> Vec<String> {
    let start = format!("<path fill=\"{fill}\" d=\"");
    svg.split(&start).skip(1).map(|rest| rest.split('"').next().unwrap().to_owned()).collect()
}

/// The frames of the panels: left, top, width, height.
fn frames(svg: &str) -> Vec<[f64; 4]> {
    let number = |tag: &str, name: &str| -> f64 {
        let (_, rest) = tag.split_once(&format!(" {name}=\"")).unwrap();
        rest.split('"').next().unwrap().parse().unwrap()
    };
    let panels = svg.split("<g class=\"panel\"").skip(1).map(|panel| panel.split("<rect").nth(1).unwrap());
    panels.map(|tag| ["x", "y", "width", "height"].map(|name| number(tag, name))).collect()
}

/// Of 1, 10 and 1000 by their logarithms, the borders are at −1/2, 1/2, 2 and 4; of 0, 1, 3 they are at −1/2, 1/2, 2
/// and 4, too.
#[test]
fn cells_end_midway_between_values() {
    for x in [CellAxis::logarithmic("x", vec![1.0, 10.0, 1000.0]), CellAxis::linear("x", vec![0.0, 1.0, 3.0])] {
        let y = CellAxis::linear("y", vec![2.0, 1.0]);
        // the lower row is the second one, for y = 1
        let panel = Panel::new("", [0.0, 1.0, 0.0, 1.0, 0.0, 0.0].map(Some).to_vec());
        let svg = HeatMap::new("", x, y, Colour::linear(""), vec![panel]).svg().unwrap();
        let [left, top, width, height] = frames(&svg)[0];
        let at = |border: f64| draw_length(left + width * (border + 0.5) / 4.5);
        let row = |n: f64| draw_length(top + height * n / 2.0);
        let rectangle =
            |from: f64, to: f64, n: f64| format!("M{} {}H{}V{}H{}z", at(from), row(n), at(to), row(n + 1.0), at(from));
        let low = rectangle(0.5, 4.0, 1.0) + &rectangle(-0.5, 0.5, 0.0) + &rectangle(2.0, 4.0, 0.0);
        let high = rectangle(-0.5, 0.5, 1.0) + &rectangle(0.5, 2.0, 0.0);
        assert_eq!(
            (paths(&svg, "#440154")[0].as_str(), paths(&svg, "#fde725")[0].as_str()),
            (low.as_str(), high.as_str())
        );
    }
}

fn draw_length(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

/// The colour of one value is the same in all panels, whatever the other values there.
#[test]
fn panels_have_one_scale() {
    let axis = |count: usize| CellAxis::linear("", even(0.0, 1.0, count));
    let of = |values: [f64; 3]| Panel::new("", values.map(Some).to_vec());
    let panels = vec![of([0.0, 5.0, 10.0]), of([5.0, 5.0, 5.0])];
    let svg = HeatMap::new("", axis(3), axis(1), Colour::linear("v"), panels).svg().unwrap();
    let middle = "#20908c";
    let frames = frames(&svg);
    let of_panels: Vec<_> = svg.split("<g class=\"panel\"").skip(1).map(|panel| paths(panel, middle)).collect();
    assert!(of_panels[0][0].starts_with(&format!("M{} ", draw_length(frames[0][0] + frames[0][2] / 3.0))));
    assert!(of_panels[1][0].starts_with(&format!("M{} ", frames[1][0])));
    // below both there is one bar
    assert_eq!(svg.matches(">v</text>").count(), 1);
}

/// Failed runs are hatched and counted, and no colour covers them.
#[test]
fn cells_without_a_value_are_hatched() {
    let axis = |count: usize| CellAxis::linear("", even(0.0, 1.0, count));
    let map =
        |cells: Vec<Option<f64>>| HeatMap::new("", axis(2), axis(1), Colour::linear(""), vec![Panel::new("", cells)]);
    let svg = map(vec![Some(1.0), None]).svg().unwrap();
    let [left, _, width, _] = frames(&svg)[0];
    assert!(svg.contains("no value: 1 cell<") && svg.matches("class=\"hatching\"").count() == 2, "panel and legend");
    let [drawn] = &paths(svg.split("<rect").nth(1).unwrap(), "#20908c")[..] else { panic!("one path") };
    assert!(
        drawn.contains(&format!("H{}V", draw_length(left + width / 2.0)))
            && !drawn.contains(&format!("H{}", left + width))
    );
    // NaN is no value either; where all values are present, there is no hatching
    assert_eq!(map(vec![Some(1.0), Some(f64::NAN)]).svg().unwrap(), svg);
    assert!(!map(vec![Some(1.0), Some(2.0)]).svg().unwrap().contains("hatching"));
    assert!(map(vec![None, None]).svg().unwrap().contains("no value: 2 cells<"));
}

#[test]
fn zero_and_infinity_have_entries_of_their_own() {
    let axis = |count: usize| CellAxis::linear("", even(0.0, 1.0, count));
    let values = [1e-9, 1e-3, 0.0, -1.0, f64::INFINITY, f64::NEG_INFINITY];
    let map = |colour: Colour| {
        let panel = Panel::new("", values.map(Some).to_vec());
        HeatMap::new("", axis(values.len()), axis(1), colour, vec![panel]).svg().unwrap()
    };
    let logarithmic = map(Colour::logarithmic(""));
    for entry in [">0: 1 cell<", ">negative: 1 cell<", ">∞: 1 cell<", ">-∞: 1 cell<"] {
        assert!(logarithmic.contains(entry), "{entry}");
    }
    let symmetric = map(Colour::symmetric_logarithmic("ΔH"));
    assert!(!symmetric.contains(">0: ") && !symmetric.contains("negative") && symmetric.contains(">∞: 1 cell<"));
    assert!(symmetric.contains("ΔH (logarithmic, linear within ±10<tspan"), "the threshold is stated");
}

/// A failed run's 10³⁰⁰ leaves the others their colours, and is counted.
#[test]
fn values_beyond_the_range_are_counted() {
    let axis = |count: usize| CellAxis::linear("", even(0.0, 1.0, count));
    let map = |values: [f64; 4], colour: Colour| {
        HeatMap::new("", axis(4), axis(1), colour, vec![Panel::new("", values.map(Some).to_vec())]).svg().unwrap()
    };
    let svg = map([1e-20, 1e-9, 1e-3, 1e300], Colour::logarithmic("").over(1e-9, 1e-3));
    assert!(svg.contains("&lt; 10<tspan") && svg.contains("&gt; 0.001: 1 cell"), "{svg}");
    // the ends have the colours of the bar, and beyond them the same ones
    assert_eq!((paths(&svg, "#440154").len(), paths(&svg, "#fde725").len()), (3, 3));
    // both sides of 0 are shown
    let svg = map([-3.0, -1.0, 1.0, 3.0], Colour::linear("").over(-1.0, 2.0));
    assert!(svg.contains("&lt; -2: 1 cell") && svg.contains("&gt; 2: 1 cell"), "{svg}");
    assert!(!map([1.0, 2.0, 3.0, 4.0], Colour::linear("").over(0.0, 9.0)).contains("&lt; "));
}

/// The colour bar has ticks at powers of ten, where these values have their colours.
#[test]
fn colour_bars_of_logarithms_have_decades() {
    let svg = schemes().svg().unwrap();
    let bar = svg.split("permanent change of H̄").last().unwrap();
    for exponent in [14, 12, 10, 8, 6, 4, 2] {
        assert!(bar.contains(&format!(">10<tspan dy=\"-0.4em\" font-size=\"0.75em\">-{exponent}</tspan></text>")));
    }
}

/// Many cells do not make many elements; as an image, they are not larger than a few bytes each.
#[test]
fn the_number_of_elements_is_bounded() {
    let noise = |count: usize| {
        let axis = || CellAxis::linear("", even(0.0, 1.0, count));
        // without order: the worst case for merged rectangles and for compression
        let mut seed = 1u64;
        let mut next = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            Some((seed >> 33) as f64)
        };
        let cells = (0..count * count).map(|_| next()).collect();
        HeatMap::new("", axis(), axis(), Colour::linear(""), vec![Panel::new("", cells)]).svg().unwrap()
    };
    let rectangles = noise(99);
    assert!(!rectangles.contains("<image") && rectangles.len() < 500_000, "{}", rectangles.len());
    assert!(noise(100).contains("<image"));
    let image = noise(400);
    assert!(image.contains("<image") && image.len() < 2 * 400 * 400, "{}", image.len());
    for svg in [rectangles, image] {
        assert!(svg.matches('<').count() < 2000, "{}", svg.matches('<').count());
    }
}

/// The image holds the colour of each cell, the upper row first, and transparent pixels where there is no value.
#[test]
fn images_hold_the_colours_of_the_cells() {
    let (columns, rows) = (120, 90);
    let axis = |count: usize| CellAxis::linear("", even(0.0, 1.0, count));
    let value = |n: usize| (n % 7 != 3).then_some((n % 11) as f64);
    let panel = Panel::new("", (0..columns * rows).map(value).collect());
    let map = HeatMap::new("", axis(columns), axis(rows), Colour::linear(""), vec![panel]);
    let svg = map.svg().unwrap();
    let encoded = svg.split("base64,").nth(1).unwrap().split('"').next().unwrap();
    let decoded = base64::Engine::decode(&base64::engine::general_purpose::STANDARD, encoded).unwrap();
    let mut decoder = png::Decoder::new(std::io::Cursor::new(decoded));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height, pixels.len()), (120, 90, 4 * columns * rows));
    let shades = shades::Shades::of(&map);
    for (pixel, place) in pixels.chunks(4).zip(0..) {
        let (i, j) = (place % columns, rows - 1 - place / columns);
        match value(i + columns * j) {
            Some(value) => {
                let [r, g, b] = shades.rgb(shades.number(Some(value)));
                assert_eq!(pixel, [r, g, b, 255], "{i} {j}");
            }
            None => assert_eq!(pixel[3], 0, "{i} {j}"),
        }
    }
}

#[test]
fn words_are_in_the_legend_with_their_marks() {
    let svg = verdicts().svg().unwrap();
    for word in ["fine", "near a resonance", "drifts", "too large", "undecided"] {
        assert_eq!(svg.matches(&format!(">{word}</text>")).count(), 1, "{word}");
    }
    // four words with marks, in the panel and in the legend
    assert_eq!(svg.matches("class=\"mark\"").count(), 8);
    assert!(svg.contains("undecided: 12 cells."), "in the description");
}

#[test]
fn texts_are_escaped() {
    let nasty = "<b> & \"it\"";
    let axis = || CellAxis::words(nasty, words(&[nasty]));
    let map = HeatMap {
        notes: words(&[nasty]),
        ..HeatMap::new(nasty, axis(), axis(), Colour::words(nasty, words(&[nasty])), vec![of_words(nasty, [Some(0)])])
    };
    let svg = map.svg().unwrap();
    assert!(!svg.contains("<b>") && !svg.contains("\"it\"") && svg.contains("&lt;b&gt;"));
}

/// Each wrong input has a sentence that names its place.
#[test]
fn wrong_inputs_are_refused() {
    let linear = |values: &[f64]| CellAxis::linear("e", values.to_vec());
    let panel = |cells: &[f64]| vec![Panel::new("Ruth 3", cells.iter().copied().map(Some).collect())];
    let of = |x: CellAxis, colour: Colour, panels: Vec<Panel>| HeatMap::new("map", x, linear(&[1.0]), colour, panels);
    let many = (0..13).map(|n| n.to_string()).collect();
    let wrong = [
        (of(linear(&[]), Colour::linear(""), panel(&[])), "the axis \"e\" has no values"),
        (of(linear(&[1.0, 2.0, 1.0]), Colour::linear(""), panel(&[0.0; 3])), "has the value 1 twice"),
        (of(linear(&[1.0, f64::NAN]), Colour::linear(""), panel(&[0.0; 2])), "the axis \"e\" has the value NaN"),
        (
            of(CellAxis::logarithmic("h", vec![0.1, 0.0]), Colour::linear(""), panel(&[0.0; 2])),
            "axis \"h\" has the value 0",
        ),
        (of(linear(&[1.0]), Colour::linear(""), vec![]), "the heat map \"map\" has no panel"),
        (of(linear(&[1.0]), Colour::linear(""), panel(&[0.0; 2])), "\"Ruth 3\" has 2 cells, but the axes have 1 and 1"),
        (of(linear(&[1.0]), Colour::linear(""), panel(&[1e300])), "1e300, which is too large for a linear scale"),
        (
            of(linear(&[1.0]), Colour::words("", words(&["a"])), panel(&[1.0])),
            "a cell 1, which is not the number of a word",
        ),
        (of(linear(&[1.0]), Colour::words("", words(&["a"])), panel(&[0.5])), "a cell 0.5, which"),
        (of(linear(&[1.0]), Colour::words("", many), panel(&[0.0])), "13 words cannot be distinguished"),
        (of(linear(&[1.0]), Colour::linear("").over(2.0, 2.0), panel(&[0.0])), "from 2e0 to 2e0 is empty"),
        (
            of(linear(&[1.0]), Colour::logarithmic("").over(0.0, 2.0), panel(&[0.0])),
            "from 0e0 to 2e0 has no logarithms",
        ),
    ];
    for (map, message) in wrong {
        let error = map.svg().unwrap_err().to_string();
        assert!(error.contains(message) && error.contains("hint: "), "{error}");
    }
}

/// Values of failed computations; none may cause a panic or an endless loop.
#[test]
fn strange_values_are_drawn() {
    let lists = [
        vec![f64::MAX, f64::MIN],
        vec![5e-324, 1e308],
        vec![1.0, 1.0 + 1e-15],
        vec![0.0, 0.0],
        vec![0.0, 5e-324],
        vec![f64::INFINITY, f64::NEG_INFINITY],
        vec![-1e-300, -1e300],
        vec![-0.0, f64::NAN],
    ];
    for values in lists {
        for colour in [Colour::linear, Colour::logarithmic, Colour::symmetric_logarithmic, Colour::automatic] {
            let panel = Panel::new("", values.iter().copied().map(Some).collect());
            for x in [vec![1e-290, 1e290], vec![1.0, 1.0 + 1e-15], vec![5e-324, 1e-310]] {
                for axis in [CellAxis::linear, CellAxis::logarithmic] {
                    let axes = (axis("x".to_owned(), x.clone()), CellAxis::linear("y", vec![0.0]));
                    let map = HeatMap::new("", axes.0, axes.1, colour(String::new()), vec![panel.clone()]);
                    match map.svg() {
                        Ok(svg) => assert!(
                            svg.len() < 60_000 && !svg.contains("NaN") && !svg.contains("inf"),
                            "{values:?} {x:?}"
                        ),
                        Err(error) => assert!(error.to_string().contains("too large for a linear scale"), "{error}"),
                    }
                }
            }
        }
    }
}

/// The whole text of a small picture, to be read after changes.
#[test]
fn a_small_picture() {
    let axes = (
        CellAxis::logarithmic("step size h", vec![0.1, 0.2]),
        CellAxis::words("scheme", words(&["Ruth 3", "Yoshida 4"])),
    );
    let colour = Colour::words("verdict", words(&["fine", "too large"]));
    let panel = of_words("Kepler", [Some(0), Some(1), Some(0), None]);
    let sheet = HeatMap::new("Verdicts", axes.0, axes.1, colour, vec![panel]).sheet().unwrap();
    insta::assert_snapshot!(sheet.svg_for_print().replace('>', ">\n"));
}
