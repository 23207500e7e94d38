//! A report of figures as one page of HTML, which contains its pictures and needs neither scripts nor a network.

mod indices;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use indices::set;

/// The whole page. All texts are plain; they are escaped when the page is written.
#[derive(Clone, Debug)]
pub(crate) struct Report {
    pub(crate) title: String,
    /// Paragraphs.
    pub(crate) introduction: Vec<String>,
    /// How it was made, as pairs of a name and a value: version, command, digits.
    pub(crate) made_with: Vec<(String, String)>,
    pub(crate) sections: Vec<Section>,
}

/// The section of one figure.
#[derive(Clone, Debug)]
pub(crate) struct Section {
    pub(crate) title: String,
    /// What the paper states, in paragraphs; none for an additional figure.
    pub(crate) stated: Vec<String>,
    pub(crate) pictures: Vec<Picture>,
    /// The results, in paragraphs.
    pub(crate) found: Vec<String>,
    pub(crate) statements: Vec<Statement>,
    pub(crate) tables: Vec<Table>,
    pub(crate) verdict: Verdict,
    /// Names of the files beside the page: SVG, CSV.
    pub(crate) files: Vec<String>,
}

/// A picture and its caption.
#[derive(Clone, Debug)]
pub(crate) struct Picture {
    /// An `<svg>` element without `id`s, as [`Chart::svg`](crate::chart::Chart::svg) gives it. It is not escaped.
    pub(crate) svg: String,
    pub(crate) caption: String,
}

/// A statement, what was found, and whether the statement holds.
#[derive(Clone, Debug)]
pub(crate) struct Statement {
    pub(crate) statement: String,
    pub(crate) found: String,
    pub(crate) holds: bool,
}

/// A table of numbers or short texts. Each row has as many cells as the header.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    pub(crate) caption: String,
    pub(crate) header: Vec<String>,
    pub(crate) rows: Vec<Vec<String>>,
}

/// Whether the results agree with what the paper states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Agrees,
    Differs,
    /// It was not computed here, or cannot be.
    NotReproduced,
    /// The paper has no such figure.
    Additional,
}

impl Verdict {
    pub(crate) fn word(self) -> &'static str {
        match self {
            Verdict::Agrees => "agrees",
            Verdict::Differs => "differs",
            Verdict::NotReproduced => "not reproduced",
            Verdict::Additional => "additional",
        }
    }

    /// `9 agree`
    fn counted(self, count: usize) -> String {
        let word = match (self, count) {
            (Verdict::Agrees, 2..) => "agree",
            (Verdict::Differs, 2..) => "differ",
            _ => self.word(),
        };
        format!("{count} {word}")
    }

    fn sentence(self) -> &'static str {
        match self {
            Verdict::Agrees => "The results agree with what the paper states.",
            Verdict::Differs => "The results differ from what the paper states.",
            Verdict::NotReproduced => "What the paper states was not reproduced here.",
            Verdict::Additional => "The paper has no such figure.",
        }
    }

    fn badge(self) -> Markup {
        let class = format!("verdict {}", self.word().replace(' ', "-"));
        html! { span class=(class) { (self.word()) } }
    }
}

const STYLE: &str = include_str!("report.css");

impl Report {
    /// The text of the page.
    pub(crate) fn html(&self) -> String {
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    title { (self.title) }
                    style { (PreEscaped(STYLE)) }
                }
                body {
                    h1 { (self.title) }
                    (paragraphs(&self.introduction))
                    dl { @for (name, value) in &self.made_with { dt { (name) } dd { (value) } } }
                    nav aria-label="Figures" { (self.contents()) }
                    main { @for (n, figure) in self.sections.iter().enumerate() { (figure.section(n + 1)) } }
                }
            }
        };
        page.into_string()
    }

    /// How many figures agree, and so on: `9 agree, 1 differs, 7 additional`.
    pub(crate) fn verdicts(&self) -> String {
        let counts = [Verdict::Agrees, Verdict::Differs, Verdict::NotReproduced, Verdict::Additional]
            .map(|verdict| (verdict, self.sections.iter().filter(|figure| figure.verdict == verdict).count()));
        let words = counts.iter().filter(|(_, count)| *count > 0).map(|(verdict, count)| verdict.counted(*count));
        words.collect::<Vec<_>>().join(", ")
    }

    fn contents(&self) -> Markup {
        html! {
            ol {
                @for (n, figure) in self.sections.iter().enumerate() {
                    li { a href={ "#figure-" (n + 1) } { (set(&figure.title)) } " " (figure.verdict.badge()) }
                }
            }
        }
    }
}

impl Section {
    fn section(&self, n: usize) -> Markup {
        let pictures = if self.pictures.len() == 1 { "pictures one" } else { "pictures" };
        html! {
            section id={ "figure-" (n) } {
                h2 { (set(&self.title)) }
                p class="verdict-line" { (self.verdict.badge()) " " (self.verdict.sentence()) }
                @if !self.stated.is_empty() { h3 { "The paper states" } (paragraphs(&self.stated)) }
                @if !self.pictures.is_empty() {
                    div class=(pictures) { @for picture in &self.pictures { (picture.figure()) } }
                }
                @if !self.found.is_empty() { h3 { "Results" } (paragraphs(&self.found)) }
                @if !self.statements.is_empty() { (statements(&self.statements)) }
                @for table in &self.tables { (table.markup()) }
                @if !self.files.is_empty() {
                    p { "Files: " @for (i, file) in self.files.iter().enumerate() {
                        @if i > 0 { ", " }
                        a href={ "./" (file) } { (file) }
                    } }
                }
            }
        }
    }
}

impl Picture {
    fn figure(&self) -> Markup {
        html! { figure { (PreEscaped(&self.svg)) figcaption { (set(&self.caption)) } } }
    }
}

impl Table {
    fn markup(&self) -> Markup {
        html! {
            // focusable, so that a wide table can be scrolled with keys
            div class="wide" tabindex="0" {
                table {
                    caption { (set(&self.caption)) }
                    thead { tr { @for name in &self.header { th scope="col" { (set(name)) } } } }
                    tbody { @for row in &self.rows { tr { @for cell in row { td { (set(cell)) } } } } }
                }
            }
        }
    }
}

fn statements(statements: &[Statement]) -> Markup {
    html! {
        table class="statements" {
            thead { tr { th scope="col" { "statement" } th scope="col" { "found" } th scope="col" { "holds" } } }
            tbody {
                @for Statement { statement, found, holds } in statements {
                    tr { td { (set(statement)) } td { (set(found)) } td { @if *holds { "yes" } @else { "no" } } }
                }
            }
        }
    }
}

fn paragraphs(texts: &[String]) -> Markup {
    html! { @for text in texts { p { (set(text)) } } }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::samples;

    fn texts<const N: usize>(texts: [&str; N]) -> Vec<String> {
        texts.map(str::to_owned).to_vec()
    }

    fn figure(title: &str, verdict: Verdict, charts: usize) -> Section {
        let pictures = samples().into_iter().take(charts).map(|(_, chart)| Picture {
            svg: chart.svg().unwrap(),
            caption: format!("{} (computed at 120 digits)", chart.title),
        });
        let row = |n: i32| vec![format!("1/{}", 10 << n), format!("{}.31e-{}", n + 1, 20 * n), (n + 2).to_string()];
        Section {
            title: title.to_owned(),
            stated: texts(["The drift is exponentially small: log₁₀ is about −c/h, with c ≈ 4.2."]),
            pictures: pictures.collect(),
            found: texts(["c = 4.19 ± 0.03 for h from 1/80 to 1/10.", "A second paragraph."]),
            statements: vec![Statement {
                statement: "The drift falls with h.".to_owned(),
                found: "at every step".to_owned(),
                holds: true,
            }],
            tables: vec![Table {
                caption: "Drift by step".to_owned(),
                header: texts(["h", "drift", "m"]),
                rows: (0..4).map(row).collect(),
            }],
            verdict,
            files: texts(["drifts.svg", "drifts.csv"]),
        }
    }

    fn report() -> Report {
        Report {
            title: "Figures of a paper, computed again".to_owned(),
            introduction: texts(["Each figure is computed from nothing but the equations."]),
            made_with: vec![("digits".to_owned(), "120".to_owned())],
            sections: vec![
                figure("Figure 1: drifts", Verdict::Agrees, 2),
                figure("Figure 2", Verdict::Differs, 1),
                figure("Figure 3", Verdict::NotReproduced, 0),
                figure("Beyond the paper", Verdict::Additional, 3),
            ],
        }
    }

    /// `SHADOWSTEP_LOOK=DIR` keeps the page, for inspection.
    #[test]
    fn page_stands_alone() {
        let page = report().html();
        if let Some(folder) = std::env::var_os("SHADOWSTEP_LOOK") {
            std::fs::write(std::path::Path::new(&folder).join("report.html"), &page).unwrap();
        }
        for wrong in ["<script", "@import", "url(", "src=", "<link"] {
            assert!(!page.contains(wrong), "{wrong}");
        }
        // the XML namespace of SVG is not fetched
        assert_eq!(page.matches("http").count(), page.matches("xmlns=\"http://www.w3.org/2000/svg\"").count());
        let mut ids: Vec<_> = page.split(" id=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
        assert_eq!(ids, ["figure-1", "figure-2", "figure-3", "figure-4"]);
        ids.retain(|id| !page.contains(&format!("href=\"#{id}\"")));
        assert!(ids.is_empty(), "no link to {ids:?}");
        assert_eq!(page.matches("<svg ").count(), 6);
    }

    #[test]
    fn texts_are_escaped_everywhere() {
        let nasty = "<b> & \"it\"";
        let mut page = report();
        let figure = &mut page.sections[0];
        page.made_with[0] = (nasty.to_owned(), nasty.to_owned());
        for text in [&mut page.title, &mut page.introduction[0]] {
            *text = nasty.to_owned();
        }
        let Statement { statement, found, .. } = &mut figure.statements[0];
        for text in [statement, found] {
            *text = nasty.to_owned();
        }
        let table = &mut figure.tables[0];
        for text in [&mut figure.title, &mut figure.stated[0], &mut figure.found[0], &mut figure.files[0]] {
            *text = nasty.to_owned();
        }
        for text in [&mut table.caption, &mut table.header[0], &mut table.rows[0][0], &mut figure.pictures[0].caption] {
            *text = nasty.to_owned();
        }
        let html = page.html();
        assert!(!html.contains("<b>") && !html.contains("\"it\""));
        // title and heading, introduction, name, value; contents, heading, stated, found, link twice; caption,
        // header, cell, picture; statement, found
        assert_eq!(html.matches("&lt;b&gt; &amp; &quot;it&quot;").count(), 17);
    }

    #[test]
    fn verdicts_are_counted() {
        assert_eq!(report().verdicts(), "1 agrees, 1 differs, 1 not reproduced, 1 additional");
        let mut more = report();
        more.sections.extend(report().sections);
        assert_eq!(more.verdicts(), "2 agree, 2 differ, 2 not reproduced, 2 additional");
        more.sections.retain(|figure| figure.verdict == Verdict::Additional);
        assert_eq!(more.verdicts(), "2 additional");
    }

    #[test]
    fn verdicts_are_words_and_not_only_colours() {
        let page = report().html();
        for verdict in [Verdict::Agrees, Verdict::Differs, Verdict::NotReproduced, Verdict::Additional] {
            assert_eq!(page.matches(&format!(">{}</span>", verdict.word())).count(), 2, "contents and section");
            assert_eq!(page.matches(verdict.sentence()).count(), 1);
        }
    }
}
