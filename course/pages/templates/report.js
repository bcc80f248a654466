// Sorts a table by the column whose heading is pressed, and hides the rows without the sought text.
for (const table of document.querySelectorAll("table.sortable")) {
  for (const [column, heading] of [...table.tHead.rows[0].cells].entries()) {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...heading.childNodes);
    heading.append(button);
    button.addEventListener("click", () => sort(table, column, heading));
  }
}
function sort(table, column, heading) {
  const falling = heading.getAttribute("aria-sort") === "ascending";
  for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
  heading.setAttribute("aria-sort", falling ? "descending" : "ascending");
  const key = (row) => row.cells[column].dataset.sort ?? row.cells[column].textContent.trim();
  const order = (a, b) => key(a) - key(b) || key(a).localeCompare(key(b), undefined, { numeric: true });
  const rows = [...table.tBodies[0].rows].sort((a, b) => (falling ? order(b, a) : order(a, b)));
  table.tBodies[0].append(...rows);
}
for (const search of document.querySelectorAll("input.search")) {
  search.closest("p").classList.remove("hidden");
  search.addEventListener("input", () => {
    const sought = search.value.toLowerCase();
    for (const row of document.querySelectorAll("tr.student")) {
      row.classList.toggle("hidden", !row.textContent.toLowerCase().includes(sought));
    }
  });
}
