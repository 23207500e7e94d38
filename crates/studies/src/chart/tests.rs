use super::layout::Layout;
use super::*;

fn axis(label: &str, scale: Scale) -> Axis {
    Axis { label: label.to_owned(), scale, range: None }
}

fn curve(label: &str, colour: usize, look: Look, points: Vec<(f64, f64)>) -> Curve {
    Curve { label: label.to_owned(), points, look, is_right: false, colour }
}

/// Nine curves over a hundred decades, against h.
fn drifts() -> Chart {
    let curves = (0..9).map(|n| {
        let h = |i: i32| f64::from(i) / 200.0;
        let c = 0.2 + 0.11 * n as f64;
        let points = (1..=40).map(|i| (h(i), -1.0 - 0.3 * n as f64 - (c / h(i)).min(115.0 - n as f64)));
        curve(&format!("scheme of order {}", n + 2), n, Look::Line, points.collect())
    });
    Chart {
        title: "Drift of the modified energy, Kepler's problem & e = 0.6".to_owned(),
        x: axis("step size h", Scale::Linear),
        y: axis("max − min of H̃ / |H|, h² units", Scale::Log10),
        marks: Vec::new(),
        second_y: None,
        curves: curves.collect(),
        notes: vec!["120 digits; t = 0 to 100; estimator of the best order m.".to_owned()],
        equal_scales: false,
        listed: false,
    }
}

/// Four curves of bumps in turn, about as small as each other between them.
fn bumps() -> Chart {
    let bump = |t: f64, centre: f64| -60.0 + 45.0 * (-(t - centre).powi(2) / 3.0).exp();
    let looks = [Look::Thick, Look::Line, Look::Dashed, Look::Dashed];
    let curves = looks.into_iter().enumerate().map(|(n, look)| {
        let points = (0..600).map(|i| f64::from(i) / 10.0).map(|t| {
            let of_turn = (0..4).map(|k| bump(t, 6.0 + 4.0 * n as f64 + 16.0 * f64::from(k)));
            (t, of_turn.fold(-60.0 - n as f64, f64::max))
        });
        curve(["h = 1/10", "h = 1/20", "h = 1/40, shifted", "h = 1/80"][n], n, look, points.collect())
    });
    Chart {
        title: "Energy error along the orbit".to_owned(),
        x: axis("time t (periods of 2π)", Scale::Linear),
        y: axis("|H̃(t) − H̃(0)|", Scale::Log10),
        marks: Vec::new(),
        second_y: None,
        curves: curves.collect(),
        notes: Vec::new(),
        equal_scales: false,
        listed: false,
    }
}

/// The estimate and its order m, which has an axis of its own.
fn orders() -> Chart {
    let h = |i: i32| f64::from(i) / 100.0;
    let estimate = (1..=30).map(|i| (h(i), -0.9 / h(i))).collect();
    let bound = (1..=30).map(|i| (h(i), if i == 12 { f64::NAN } else { 4.0 - 0.8 / h(i) })).collect();
    let order = (1..=30).map(|i| (h(i), (1.5 / h(i)).round().min(60.0))).collect();
    Chart {
        title: "The best order of the estimator".to_owned(),
        x: axis("step size h", Scale::Linear),
        y: axis("estimated error", Scale::Log10),
        marks: Vec::new(),
        second_y: Some(axis("order m", Scale::Linear)),
        curves: vec![
            curve("estimate", 0, Look::Line, estimate),
            curve("bound of the theory", 1, Look::Dashed, bound),
            Curve { is_right: true, ..curve("m", 2, Look::Points(Marker::Cross), order) },
        ],
        notes: Vec::new(),
        equal_scales: false,
        listed: false,
    }
}

/// Samples with their names.
pub(crate) fn samples() -> [(&'static str, Chart); 4] {
    [("drifts", drifts()), ("bumps", bumps()), ("orders", orders()), ("schemes", schemes())]
}

/// `SHADOWSTEP_LOOK=DIR` keeps the pictures, for inspection.
#[test]
pub(crate) fn samples_are_drawn_whole() {
    for (name, chart) in samples() {
        let svg = chart.svg();
        if let Some(folder) = std::env::var_os("SHADOWSTEP_LOOK") {
            std::fs::write(std::path::Path::new(&folder).join(format!("{name}.svg")), &svg).unwrap();
        }
        for label in chart.curves.iter().map(|curve| &curve.label).chain([&chart.x.label]) {
            assert!(svg.contains(label), "{name} lacks {label}");
        }
        // one page contains many, so that ids would clash
        let ticks = ["drifts", "orders"]
            .contains(&name)
            .then_some(">10<tspan dy=\"-0.4em\" font-size=\"0.75em\">-20</tspan></text>");
        assert!(ticks.is_none_or(|tick| svg.contains(tick)), "{name} lacks 10⁻²⁰");
        for wrong in [" id=", "<script", "NaN", "inf"] {
            assert!(!svg.contains(wrong), "{name} has {wrong}");
        }
        assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>"), "{name}");
        assert_eq!(svg.matches("<text").count(), svg.matches("</text>").count(), "{name}");
    }
}

/// The numbers of all `points` attributes.
fn polylines(svg: &str) -> Vec<Vec<(f64, f64)>> {
    let point = |pair: &str| pair.split_once(',').map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap())).unwrap();
    let lists = svg.split(" points=\"").skip(1).map(|rest| rest.split('"').next().unwrap());
    lists.map(|list| list.split_whitespace().map(point).collect()).collect()
}

#[test]
fn curves_stay_within_the_plot() {
    let wave = (0..200).map(|i| f64::from(i) / 10.0).map(|x| (x, 30.0 * x.sin())).collect();
    let mut chart =
        Chart { curves: vec![curve("wave", 3, Look::Line, wave)], marks: Vec::new(), notes: Vec::new(), ..bumps() };
    chart.x.range = Some((2.0, 15.0));
    chart.y = Axis { range: Some((-10.0, 20.0)), ..axis("y", Scale::Linear) };
    let svg = chart.svg();
    let lines = polylines(&svg);
    let Layout { plot, .. } = Layout::of(&chart);
    let (left, top, right, bottom) = (plot.left, plot.top, plot.right(), plot.bottom());
    let of_curve: Vec<_> = lines.iter().filter(|line| line.len() > 3).collect();
    assert!(of_curve.len() >= 4, "cut at y = −10 and 20 in each period");
    for &(x, y) in of_curve.iter().copied().flatten() {
        assert!((left..=right).contains(&x) && (top..=bottom).contains(&y), "{x} {y} in {plot:?}");
    }
    assert!(of_curve.iter().filter(|line| line.iter().any(|point| point.1 == top)).count() >= 2, "no bend before");
}

/// A circle stays one, whether the curves are higher or wider than the plot; a thin ellipse fills the plot.
#[test]
fn equal_scales_show_circles() {
    let ellipse = |a: f64, b: f64| {
        let points = (0..=360).map(|i| f64::from(i).to_radians()).map(|t| (a * t.cos(), b * t.sin())).collect();
        let curves = vec![Curve::line("orbit", points, 0)];
        let chart = Chart { equal_scales: true, ..Chart::new("", Axis::linear("x"), Axis::linear("y"), curves) };
        let svg = chart.svg();
        let line = polylines(&svg).into_iter().max_by_key(Vec::len).unwrap();
        let extent = |values: Vec<f64>| {
            let (least, most) = values.iter().fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(*v), b.max(*v)));
            most - least
        };
        extent(line.iter().map(|point| point.0).collect()) / extent(line.iter().map(|point| point.1).collect())
    };
    for (a, b) in [(1.0, 1.0), (3.0, 1.0), (1.0, 3.0), (1e-8, 2e-8)] {
        assert!((ellipse(a, b) / (a / b) - 1.0).abs() < 0.01, "{a} {b}: {}", ellipse(a, b));
    }
    assert!(ellipse(1.0, 1e-6) < 2.0, "{}", ellipse(1.0, 1e-6));
}

#[test]
fn labels_do_not_overlap_with_many_curves_of_one_end() {
    let curves = (0..25).map(|n| curve(&format!("curve {n}"), n, Look::Line, vec![(0.0, 0.0), (1.0, 1.0)]));
    let svg = Chart { curves: curves.collect(), ..drifts() }.svg();
    let mut rows: Vec<f64> = svg
        .split("<text ")
        .filter(|text| text.contains(">curve "))
        .map(|text| text.split(" y=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap())
        .collect();
    rows.sort_by(f64::total_cmp);
    assert_eq!(rows.len(), 25);
    assert!(rows.windows(2).all(|pair| pair[1] - pair[0] >= 19.0), "{rows:?}");
}

/// Twelve schemes of a work–precision diagram, whose curves end close together.
fn schemes() -> Chart {
    let of =
        |n: i32| (0..7).map(move |i| (f64::from(i + n) * 200.0, 10_f64.powf(-1.0 - f64::from(i * (4 + n % 3)) / 4.0)));
    let curves = (0..12).map(|n| {
        let points: Vec<_> = of(n).collect();
        Curve::marked(format!("scheme {}", n + 1), log10_of(&points, (true, true)), n as usize)
    });
    Chart::new("Work and precision", Axis::log10("force evaluations"), Axis::log10("error of H"), curves.collect())
}

/// A marker with its dashes is that of one curve only: without colours, and for any colour vision.
#[test]
fn twelve_curves_differ_without_colours() {
    let looks = schemes().curves.iter().map(|curve| Marker::of(curve.colour)).collect::<Vec<_>>();
    assert!((0..12).all(|n| !looks[..n].contains(&looks[n])), "{looks:?}");
    let svg = schemes().svg();
    assert_eq!(svg.matches("stroke-dasharray").count(), 6, "three lines and their samples");
    assert_eq!(
        svg.matches("fill=\"#").count() - svg.matches("<text").count(),
        2 * 4 + 1,
        "filled markers and samples, paper"
    );
}

/// The attributes and the content of each text of a picture.
fn texts(svg: &str) -> impl Iterator<Item = (&str, &str)> {
    svg.split("<text ").skip(1).filter_map(|text| text.split_once("</text>")?.0.split_once('>'))
}

/// The label of each curve has the colour of its line and of its markers, also where a style sheet changes it.
#[test]
fn labels_have_the_colours_of_their_curves() {
    let kinds = [Curve::line, Curve::marked, Curve::thick, Curve::dashed, Curve::unjoined];
    for (colour, kind) in (0..12).flat_map(|colour| kinds.map(|kind| (colour, kind))) {
        let this = kind("this one", vec![(0.0, 0.0), (1.0, 1.0)], colour);
        let svg = Chart::new("", Axis::linear("x"), Axis::linear("y"), vec![this.clone()]).svg();
        let (attributes, _) = texts(&svg).find(|(_, label)| *label == "this one").unwrap();
        let as_curve = attributes.split(' ').filter(|part| part.starts_with("fill=") || part.starts_with("class="));
        let as_curve = as_curve.collect::<Vec<_>>().join(" ");
        assert!(as_curve.contains(this.ink().colour), "{colour}: {attributes}");
        let of_line = as_curve.replace("fill", "stroke");
        assert!(svg.contains(&of_line) || svg.matches(&as_curve).count() > 1, "{colour}: {as_curve}");
    }
}

/// Charts that are compared have one order of labels, wherever the curves end, and no leaders.
#[test]
fn listed_labels_are_in_the_order_of_the_curves() {
    let of = |listed: bool| {
        let svg = Chart { listed, ..schemes() }.svg();
        let labels: Vec<_> = texts(&svg).filter(|(_, label)| label.starts_with("scheme ")).collect();
        let row = |attributes: &str| attributes.split(" y=\"").nth(1)?.split('"').next()?.parse::<f64>().ok();
        let rows: Vec<_> = labels.iter().map(|(attributes, _)| row(attributes).unwrap()).collect();
        (rows.is_sorted(), svg.matches("#888888").count())
    };
    assert_eq!(of(true), (true, 0));
    let (sorted, leaders) = of(false);
    assert!(!sorted && leaders > 0);
}

/// Numbers of a picture can be searched and copied.
#[test]
fn the_minus_of_a_picture_is_that_of_ascii() {
    let falling = (1..=40).map(|n| (f64::from(n), -f64::from(n))).collect::<Vec<_>>();
    for y in [Axis::linear("max − min"), Axis::log10("max − min")] {
        let svg = Chart::new("−1", Axis::linear("x"), y, vec![Curve::line("−2", falling.clone(), 0)]).svg();
        assert!(!svg.contains('−') && !svg.contains('⁻') && svg.contains("max - min"));
        assert!(texts(&svg).any(|(_, text)| text == "-20" || text.contains(">-20<")), "{svg}");
    }
}

/// The label of a jump is in its middle, or above one that is lower than the label.
#[test]
fn labels_of_jumps_stand_at_them() {
    let row = |jump: (f64, f64)| {
        let points = vec![(0.0, jump.0), (5.0, jump.0), (5.0, jump.1), (10.0, jump.1)];
        let y = Axis::linear("y").over(0.0, 10.0);
        let mut chart = Chart::new("", Axis::linear("x"), y, vec![Curve::line("step", points, 0)]);
        chart.marks = vec![Mark::at(5.0, "up").of_jump(jump.0, jump.1)];
        let svg = chart.svg();
        let line = polylines(&svg).into_iter().find(|line| line.len() == 4).unwrap();
        let (attributes, _) = texts(&svg).find(|(_, label)| *label == "up").unwrap();
        let row = attributes.split(" y=\"").nth(1).unwrap().split('"').next().unwrap().parse::<f64>().unwrap();
        (row, line[0].1, line[3].1)
    };
    let (label, low, high) = row((2.0, 8.0));
    assert!((label - f64::midpoint(low, high)).abs() < 1.0);
    let (label, low, high) = row((5.0, 5.1));
    assert!(label < high - 10.0 && high < low, "{label} {high}");
    let (label, low, _) = row((9.9, 10.0));
    assert!(label > low + 10.0, "{label} {low}");
}

#[test]
fn logarithms_of_what_is_not_positive_are_missing() {
    let points = log10_of(&[(100.0, 1e-3), (0.0, 10.0), (10.0, -1.0)], (true, true));
    assert_eq!(points[0], (2.0, -3.0));
    assert!(points[1].0.is_nan() && points[1].1 == 1.0 && points[2].1.is_nan());
    assert_eq!(log10_of(&[(-5.0, 10.0)], (false, true)), [(-5.0, 1.0)]);
}

#[test]
fn pictures_of_long_runs_stay_small() {
    let wave = (0..200_000).map(f64::from).map(|t| (t, (t / 300.0).sin())).collect();
    let svg = Chart::new("", Axis::linear("t"), Axis::linear("H"), vec![Curve::line("H", wave, 0)]).svg();
    assert!(svg.len() < 60_000, "{}", svg.len());
}

/// For a paper the colours are fixed; otherwise the same picture.
#[test]
fn printed_pictures_do_not_follow_the_screen() {
    let [screen, print] = [schemes().svg(), schemes().svg_for_print()];
    assert!(screen.contains("prefers-color-scheme") && !print.contains("prefers-color-scheme"));
    let [first, second] = [&screen, &print].map(|svg| svg.split_once("</style>").unwrap().1.to_owned());
    assert_eq!(first, second);
}

/// A label of a mark is read over curves and lines: it comes after them, on its halo.
#[test]
fn labels_of_marks_have_a_halo() {
    let svg = Chart { marks: vec![Mark::at(20.0, "escape")], ..bumps() }.svg();
    let halo = svg.find("stroke=\"#FFFFFF\"").unwrap();
    assert_eq!(svg.matches(">escape</text>").count(), 2);
    // of the curves with 600 points, the pieces of the last one
    let long = svg.match_indices(" points=\"").filter(|(at, _)| svg[at + 9..].find('"').is_some_and(|end| end > 1000));
    let last_of_a_curve = long.map(|(at, _)| at).last().unwrap();
    assert!(last_of_a_curve < halo && halo < svg.find(">escape</text>").unwrap());
}

/// Values of failed computations; none may cause a panic or an endless loop.
#[test]
fn strange_values_are_drawn_or_left_out() {
    let lists = [
        vec![],
        vec![(1.0, f64::NAN)],
        vec![(1.0, 2.0)],
        vec![(1.0, 2.0), (1.0, 2.0)],
        vec![(0.0, f64::NEG_INFINITY), (1.0, f64::INFINITY), (2.0, 1.0)],
        vec![(0.0, -1e308), (1.0, 1e308), (f64::MAX, 0.0)],
        vec![(0.0, 5e-324), (1.0, 1e-310)],
        vec![(1e9, 1.0), (1e9 + 1e-7, 1.0 + 1e-15)],
    ];
    for points in lists {
        for scale in [Scale::Linear, Scale::Log10] {
            for look in [Look::Line, Look::Dashed, Look::Thick, Look::Points(Marker::Star)] {
                for second_y in [None, Some(axis("y", scale))] {
                    let curves = vec![
                        curve("a", 0, look, points.clone()),
                        Curve { is_right: true, ..curve("b", 100, look, points.clone()) },
                    ];
                    let [x, y] = ["x", "y"].map(|name| axis(name, scale));
                    let chart = Chart { second_y, ..Chart::new("", x, y, curves) };
                    let svg = chart.svg();
                    assert!(svg.len() < 20_000 && !svg.contains("NaN"), "{points:?} {scale:?} {look:?}");
                }
            }
        }
    }
    let none = Chart { curves: Vec::new(), ..bumps() };
    assert!(none.svg().contains("Energy error"));
}

#[test]
fn texts_are_escaped() {
    let chart = Chart { title: "a < b & \"c\"".to_owned(), notes: vec!["</svg>".to_owned()], ..orders() };
    let svg = chart.svg();
    assert_eq!(svg.matches("a &lt; b &amp; &quot;c&quot;").count(), 2, "the name and the heading");
    assert_eq!((svg.matches("</svg>").count(), svg.matches("&lt;/svg&gt;").count()), (1, 1));
}

/// Steps are often given from large to small; labels are at the right nevertheless.
#[test]
fn labels_are_where_curves_end_at_the_right() {
    let falling = [(0.0, 0.0), (1.0, 3.0), (2.0, 9.0)];
    let of = |points: Vec<(f64, f64)>| {
        let other = curve("other", 1, Look::Line, vec![(0.0, 9.0), (2.0, 0.0)]);
        let chart = Chart { curves: vec![curve("this one", 0, Look::Thick, points), other], ..bumps() };
        let svg = chart.svg();
        svg.split("<text ").find(|text| text.contains(">this one<")).unwrap().to_owned()
    };
    assert_eq!(of(falling.to_vec()), of(falling.into_iter().rev().collect()));
}

/// T_{m,m} has a subscript, which ends where the next letter stands on the line again.
#[test]
fn indices_are_lowered() {
    let labelled = curve("T_{m,m} and E_40", 0, Look::Line, vec![(0.0, 0.0), (1.0, 1.0)]);
    let svg = Chart { curves: vec![labelled], ..bumps() }.svg();
    let lowered = |index: &str| format!("<tspan dy=\"0.3em\" font-size=\"0.75em\">{index}</tspan>");
    assert!(svg.contains(&lowered("m,m")) && svg.contains(&lowered("40")) && !svg.contains("E_40"), "{svg}");
}

#[test]
fn charts_stand_below_each_other() {
    let [(_, first), (_, second), ..] = samples();
    let heights = [&first, &second].map(|chart| Layout::of(chart).height.ceil());
    let picture = stacked("two", &[first, second]);
    assert!(picture.contains("<svg y=\"0\"") && picture.contains(&format!("<svg y=\"{}\"", heights[0])));
    assert!(
        picture.starts_with("<svg ") && picture.contains(&format!("height=\"{}\" viewBox", heights[0] + heights[1]))
    );
    assert_eq!(picture.matches("</svg>").count(), 3);
}
