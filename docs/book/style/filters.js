/* Above each long table: a field whose words choose rows. A word is looked for in all cells; order=4, forces<=6 and name=blanes compare a column. */

const LONG = 12;

/** What a word asks of a row. */
function condition(word, columns) {
    const [, name, sign, wanted] = word.match(/^([^<>=]+)(<=|>=|<|>|=)(.+)$/) ?? [];
    const column = name === undefined ? -1 : columns.findIndex((own) => own.startsWith(name));
    if (column < 0) return (cells) => cells.some((cell) => cell.includes(word));
    const number = Number(wanted);
    return (cells) => {
        const cell = cells[column] ?? "", value = parseFloat(cell);
        switch (sign) {
            case "=": return Number.isNaN(number) ? cell.includes(wanted) : value === number;
            case "<": return value < number;
            case ">": return value > number;
            case "<=": return value <= number;
            default: return value >= number;
        }
    };
}

function addFilter(table) {
    const text = (cell) => cell.textContent.trim().toLowerCase();
    const columns = [...table.tHead.rows[0].cells].map((cell) => text(cell).replaceAll(" ", "-"));
    const rows = [...table.tBodies[0].rows].map((row) => [row, [...row.cells].map(text)]);
    const numbers = columns.findIndex((_, i) => i > 0 && /^[0-9.]+$/.test(rows[0][1][i]));
    const example = numbers < 0 ? "a word" : `a word, or ${columns[numbers]}=${rows[0][1][numbers]}`;
    const field = Object.assign(document.createElement("input"), {
        type: "search",
        className: "filter",
        placeholder: `Filter ${rows.length} rows: ${example}`,
        ariaLabel: "Filter the rows of the table",
    });
    field.addEventListener("input", () => {
        const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
        const conditions = words.map((word) => condition(word, columns));
        for (const [row, cells] of rows) row.hidden = !conditions.every((holds) => holds(cells));
    });
    (table.closest(".table-wrapper") ?? table).before(field);
}

document.addEventListener("DOMContentLoaded", () => {
    for (const table of document.querySelectorAll("article table.docutils")) {
        if (table.tHead && table.tBodies[0]?.rows.length >= LONG) addFilter(table);
    }
});
