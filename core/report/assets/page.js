"use strict";
// Tables: a click on a header sorts by it, rising, then falling, then as it was. What was not measured comes last.
function keyOf(row, column) {
  const cell = row.cells[column];
  if (cell.hasAttribute("data-none")) return null;
  const value = cell.getAttribute("data-value");
  return value === null ? cell.textContent : Number(value);
}
function compareKeys(a, b, direction) {
  if (a === null || b === null) return (a === null) - (b === null);
  if (typeof a === "number" && typeof b === "number") return direction * (a - b);
  return direction * String(a).localeCompare(String(b), undefined, {numeric: true});
}
function sortTable(table, original, column, direction) {
  const rows = original.slice();
  if (direction !== 0) rows.sort((a, b) => compareKeys(keyOf(a, column), keyOf(b, column), direction));
  table.tBodies[0].append(...rows);
}
for (const table of document.querySelectorAll("table.sortable")) {
  const original = Array.from(table.tBodies[0].rows);
  const headers = Array.from(table.tHead.rows[0].cells);
  headers.forEach((header, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...header.childNodes);
    header.append(button);
    button.addEventListener("click", () => {
      const before = header.getAttribute("aria-sort");
      const after = before === null ? "ascending" : before === "ascending" ? "descending" : null;
      for (const other of headers) other.removeAttribute("aria-sort");
      if (after !== null) header.setAttribute("aria-sort", after);
      sortTable(table, original, column, after === "ascending" ? 1 : after === "descending" ? -1 : 0);
    });
  });
}
// Pictures: a click enlarges, arrow keys go through the strip in place, so that differences flicker.
const viewer = document.createElement("dialog");
viewer.innerHTML = "<img alt=''><p></p>";
document.body.append(viewer);
const viewed = {strip: [], index: 0};
const whole = new Map();  // from a figure to its picture in full size, where the folder beside the page has it
function loadWhole(figure) {
  if (whole.has(figure)) return;
  const image = new Image();
  whole.set(figure, image);
  image.addEventListener("load", () => { if (viewer.open && viewed.strip[viewed.index] === figure) show(viewed.index); });
  image.src = figure.querySelector("a.enlarge").href;
}
function show(index) {
  viewed.index = (index + viewed.strip.length) % viewed.strip.length;
  const figure = viewed.strip[viewed.index];
  const caption = figure.querySelector("figcaption").firstChild.textContent.trim();
  const image = viewer.querySelector("img");
  const full = whole.get(figure);
  image.src = full !== undefined && full.naturalWidth > 0 ? full.src : figure.querySelector("img").src;
  image.alt = caption;
  const words = viewer.querySelector("p");
  words.textContent = caption;
  const help = document.createElement("span");
  help.textContent = (viewed.index + 1) + " of " + viewed.strip.length + "; arrow keys change, Esc closes";
  words.append(help);
}
for (const link of document.querySelectorAll("a.enlarge")) {
  link.addEventListener("click", (event) => {
    event.preventDefault();
    const figure = link.closest("figure");
    viewed.strip = Array.from(figure.parentElement.children);
    viewed.strip.forEach(loadWhole);
    show(viewed.strip.indexOf(figure));
    viewer.showModal();
  });
}
viewer.addEventListener("click", () => viewer.close());
viewer.addEventListener("keydown", (event) => {
  if (event.key === "ArrowRight") show(viewed.index + 1);
  if (event.key === "ArrowLeft") show(viewed.index - 1);
});
// Contents: which section is being read.
const entries = new Map(Array.from(document.querySelectorAll(".contents a"), (a) => [a.hash.slice(1), a]));
function markSection() {
  let here = null;
  for (const chapter of document.querySelectorAll(".chapter")) {
    if (chapter.getBoundingClientRect().top < 0.3 * window.innerHeight) here = chapter.id;
  }
  for (const [id, link] of entries) link.classList.toggle("here", id === here);
}
addEventListener("scroll", markSection, {passive: true});
markSection();
