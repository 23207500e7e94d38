//! A report of figures as one page of HTML, which contains its pictures and needs neither scripts nor a network.

mod subscripts;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::chart::Chart;
use crate::finding::{Finding, Statement, Table};
use crate::verdict::{Counts, Verdict};
use subscripts::set;

/// The whole page. All texts are plain; they are escaped when the page is written.
#[derive(Clone, Debug)]
pub struct Report {
    /// Its heading.
    pub title: String,
    /// What it is of, which stands first, and further paragraphs on how it was computed.
    pub introduction: Vec<String>,
    /// A remark beside the counts of verdicts, on what they cannot decide.
    pub remark: Option<String>,
    /// How it was made, as pairs of a name and a value: version, command, digits.
    pub made_with: Vec<(String, String)>,
    /// In their order on the page.
    pub sections: Vec<Section>,
}

/// The section of one figure, case or problem.
#[derive(Clone, Debug)]
pub struct Section {
    /// Its heading.
    pub title: String,
    /// The paper's figure; none for an additional one.
    pub of_paper: Option<String>,
    /// What it shows.
    pub finding: Finding,
    /// Names of the files beside the page: SVG, CSV.
    pub files: Vec<String>,
}

/// Charts before the contents.
const MOST_PICTURES: usize = 3;

const STYLE: &str = include_str!("page.css");

impl Report {
    /// A page without sections, which this command of this version of the program makes.
    pub fn new(title: &str, command: &str) -> Self {
        let made_with =
            [("program", format!("shadowstep {}", env!("CARGO_PKG_VERSION"))), ("command", command.to_owned())];
        Report {
            title: title.to_owned(),
            introduction: Vec::new(),
            remark: None,
            made_with: made_with.map(|(name, value)| (name.to_owned(), value)).to_vec(),
            sections: Vec::new(),
        }
    }

    /// The text of the page: first what was found, then how.
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
                    (paragraphs(&self.introduction[..self.introduction.len().min(1)]))
                    (self.highlights())
                    @if self.is_of_paper() { (self.counts()) } @else if self.count(false).all() > 0 { p { (self.count(false)) "." } }
                    @if let Some(remark) = &self.remark { p { (set(remark)) } }
                    @if self.sections.len() > 1 { nav aria-label="Figures" { (self.contents()) } }
                    h2 { "How it was computed" }
                    (paragraphs(self.introduction.get(1..).unwrap_or_default()))
                    dl { @for (name, value) in &self.made_with { dt { (name) } dd { (value) } } }
                    main { @for (n, figure) in self.sections.iter().enumerate() { (figure.section(n + 1, self.is_of_paper())) } }
                }
            }
        };
        page.into_string()
    }

    /// Whether it compares anything with figures of a paper.
    fn is_of_paper(&self) -> bool {
        self.sections.iter().any(|figure| figure.of_paper.is_some())
    }

    /// How many statements agree, differ, and are not decided: of the paper, and additional ones.
    pub fn verdicts(&self) -> String {
        let [paper, additional] = [true, false].map(|of_paper| self.count(of_paper));
        let lines = [("statements of the paper", paper), ("additional statements", additional)];
        let lines = lines.into_iter().filter(|(_, counts)| counts.all() > 0);
        lines.map(|(what, counts)| format!("{what}: {counts}")).collect::<Vec<_>>().join("; ")
    }

    fn count(&self, of_paper: bool) -> Counts {
        let sections = self.sections.iter().filter(|figure| figure.of_paper.is_some() == of_paper);
        Counts::of(sections.flat_map(|figure| &figure.finding.statements).map(|statement| statement.verdict))
    }

    /// The results that matter most, each with a link to its section, and the first chart of each of these.
    fn highlights(&self) -> Markup {
        let highlighted =
            || self.sections.iter().enumerate().filter(|(_, figure)| !figure.finding.highlights.is_empty());
        html! {
            @for (n, figure) in highlighted() {
                @for highlight in &figure.finding.highlights {
                    p class="finding" {
                        (set(highlight)) " " a href={ "#figure-" (n + 1) } { "→ " (set(&figure.title)) }
                    }
                }
            }
            @if self.is_of_paper() && highlighted().next().is_some() {
                div class="pictures" {
                    @for (_, figure) in highlighted().take(MOST_PICTURES) {
                        @if let Some(chart) = figure.finding.charts.first() { (picture(chart)) }
                    }
                }
            }
        }
    }

    fn counts(&self) -> Markup {
        let rows = [("statements of the paper", true), ("additional statements", false)];
        html! {
            table class="counts" {
                thead { tr { th {} th scope="col" { "agree" } th scope="col" { "differ" } th scope="col" { "not \
                    decided" } } }
                tbody {
                    @for (what, counts) in rows.map(|(what, of_paper)| (what, self.count(of_paper))) {
                        tr {
                            th scope="row" { (what) }
                            td { (counts.agree) } td { (counts.differ) } td { (counts.not_decided) }
                        }
                    }
                }
            }
        }
    }

    fn contents(&self) -> Markup {
        html! {
            ol {
                @for (n, figure) in self.sections.iter().enumerate() {
                    li {
                        a href={ "#figure-" (n + 1) } { (set(&figure.title)) }
                        @if let Some(of_paper) = &figure.of_paper { " (" (of_paper) ")" }
                        " "
                        @if self.is_of_paper() {
                            (figure.badge())
                        } @else if !figure.finding.statements.is_empty() {
                            "– " (figure.all_counts())
                        }
                    }
                }
            }
        }
    }
}

impl Section {
    /// What its statements are together; a section without any is not reproduced.
    fn word(&self) -> &'static str {
        match &self.of_paper {
            None => "additional",
            Some(_) if self.finding.statements.is_empty() => "not reproduced",
            Some(_) => Verdict::of_all(self.finding.statements.iter().map(|statement| statement.verdict)).word(),
        }
    }

    fn all_counts(&self) -> Counts {
        Counts::of(self.finding.statements.iter().map(|statement| statement.verdict))
    }

    fn badge(&self) -> Markup {
        badge(self.word())
    }

    /// The n-th section, of a report that compares with figures of a paper or not.
    fn section(&self, n: usize, in_report_of_paper: bool) -> Markup {
        let counts = self.all_counts();
        html! {
            section id={ "figure-" (n) } {
                h2 { (set(&self.title)) }
                @if in_report_of_paper {
                    p class="verdict-line" {
                        (self.badge()) " "
                        @match &self.of_paper {
                            Some(of_paper) => { "Of the paper: " (of_paper) ". " }
                            None => { "The paper has no such figure. " }
                        }
                        @if counts.all() > 0 { "Statements: " (counts) "." }
                    }
                }
                @if !self.finding.stated.is_empty() {
                    div class="stated" {
                        h3 { @if in_report_of_paper { "The paper states" } @else { "Theory" } }
                        (paragraphs(&self.finding.stated))
                    }
                }
                @if !self.finding.charts.is_empty() {
                    div class="pictures" { @for chart in &self.finding.charts { (picture(chart)) } }
                }
                @if !self.finding.highlights.is_empty() || !self.finding.found.is_empty() { h3 { "Results" } }
                (paragraphs(&self.finding.highlights))
                (paragraphs(&self.finding.found))
                @if !self.finding.statements.is_empty() { (statements(&self.finding.statements, in_report_of_paper)) }
                @for of_finding in &self.finding.tables { (table(of_finding)) }
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

/// A word that is more than a colour.
fn badge(word: &str) -> Markup {
    html! { span class={ "verdict " (word.replace(' ', "-")) } { (word) } }
}

fn picture((chart, caption): &(Chart, String)) -> Markup {
    html! { figure { (PreEscaped(chart.svg())) figcaption { (set(caption)) } } }
}

fn table(Table { caption, header, rows }: &Table) -> Markup {
    html! {
        // focusable, so that a wide table can be scrolled with keys
        div class="wide" tabindex="0" {
            table {
                caption { (set(caption)) }
                thead { tr { @for name in header { th scope="col" { (set(name)) } } } }
                tbody { @for row in rows { tr { @for cell in row { td { (set(cell)) } } } } }
            }
        }
    }
}

/// `whole` statements have a column that says so; else it has names.
fn statements(statements: &[Statement], whole: bool) -> Markup {
    html! {
        table class="statements" {
            thead { tr { th scope="col" { @if whole { "statement" } } th scope="col" { "found" } th scope="col" { "verdict" } } }
            tbody {
                @for row in statements {
                    tr {
                        td { (set(&row.statement)) }
                        td {
                            (set(&row.found))
                            @if let Some(reason) = row.verdict.reason() { div class="reason" { (set(reason)) } }
                        }
                        td { (badge(row.verdict.word())) }
                    }
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

    fn figure(title: &str, of_paper: Option<&str>, verdicts: &[Verdict], charts: usize) -> Section {
        let charts: Vec<_> = samples().into_iter().take(charts).map(|(_, chart)| chart).collect();
        let caption = |chart: &Chart| format!("{} (computed at 120 digits)", chart.title);
        let row = |n: i32| vec![format!("1/{}", 10 << n), format!("{}.31e-{}", n + 1, 20 * n), (n + 2).to_string()];
        let statement = |&verdict: &Verdict| Statement {
            statement: "The drift falls with h.".to_owned(),
            found: "at every step".to_owned(),
            verdict,
        };
        Section {
            title: title.to_owned(),
            of_paper: of_paper.map(str::to_owned),
            finding: Finding {
                stated: texts(["The drift is exponentially small: log₁₀ is about −c/h, with c ≈ 4.2."]),
                charts: charts.iter().map(|chart| (chart.clone(), caption(chart))).collect(),
                highlights: texts(["The drift is the estimator's."]),
                found: texts(["c = 4.19 ± 0.03 for h from 1/80 to 1/10.", "A second paragraph."]),
                statements: verdicts.iter().map(statement).collect(),
                tables: vec![Table {
                    caption: "Drift by step".to_owned(),
                    header: texts(["h", "drift", "m"]),
                    rows: (0..4).map(row).collect(),
                }],
            },
            files: texts(["drifts.svg", "drifts.csv"]),
        }
    }

    fn report() -> Report {
        use Verdict::{Agrees, Differs};
        let open = Verdict::NotDecided("More would decide.");
        Report {
            title: "Figures of a paper, computed again".to_owned(),
            remark: Some("A quick report.".to_owned()),
            introduction: texts(["Each figure is computed from nothing but the equations."]),
            made_with: vec![("digits".to_owned(), "120".to_owned())],
            sections: vec![
                figure("Drifts", Some("figure 1"), &[Agrees, Agrees], 2),
                figure("Steps", Some("figure 2"), &[Agrees, Differs, open], 1),
                figure("Orders", Some("figure 3"), &[open, Agrees], 0),
                figure("Phases", Some("figure 4"), &[], 0),
                figure("Beyond the paper", None, &[Agrees], 3),
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
        assert_eq!(ids, ["figure-1", "figure-2", "figure-3", "figure-4", "figure-5"]);
        ids.retain(|id| !page.contains(&format!("href=\"#{id}\"")));
        assert!(ids.is_empty(), "no link to {ids:?}");
        // two of them are also beside the results that matter most
        assert_eq!(page.matches("<svg ").count(), 8);
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
        let Statement { statement, found, .. } = &mut figure.finding.statements[0];
        for text in [statement, found] {
            *text = nasty.to_owned();
        }
        let table = &mut figure.finding.tables[0];
        for text in
            [&mut figure.title, &mut figure.finding.stated[0], &mut figure.finding.highlights[0], &mut figure.files[0]]
        {
            *text = nasty.to_owned();
        }
        for text in [&mut table.caption, &mut table.header[0], &mut table.rows[0][0], &mut figure.finding.charts[0].1] {
            *text = nasty.to_owned();
        }
        let html = page.html();
        assert!(!html.contains("<b>") && !html.contains("\"it\""));
        // title and heading, introduction, name, value; contents, finding with its link, its picture, heading, stated,
        // finding, link twice; caption, header, cell, picture; statement, found
        assert_eq!(html.matches("&lt;b&gt; &amp; &quot;it&quot;").count(), 20);
    }

    #[test]
    fn verdicts_are_counted() {
        let counts = "statements of the paper: 4 agree, 1 differs, 2 not decided; additional statements: 1 agrees, 0 \
            differ, 0 not decided";
        assert_eq!(report().verdicts(), counts);
        let mut fewer = report();
        fewer.sections.truncate(1);
        assert_eq!(fewer.verdicts(), "statements of the paper: 2 agree, 0 differ, 0 not decided");
    }

    /// Every verdict is a word and not only a colour, in the contents and in the section.
    #[test]
    fn sections_have_the_verdict_of_their_statements() {
        let words: Vec<_> = report().sections.iter().map(Section::word).collect();
        assert_eq!(words, ["agrees", "differs", "not decided", "not reproduced", "additional"]);
        let page = report().html();
        for word in ["not reproduced", "additional"] {
            assert_eq!(page.matches(&format!(">{word}</span>")).count(), 2, "contents and section: {word}");
        }
        assert_eq!(page.matches(">differs</span>").count(), 3, "contents, section and statement");
    }
}
