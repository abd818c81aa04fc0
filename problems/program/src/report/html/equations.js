// Long equations go on in the next line, at a sign between terms.

const writtenOut = new Map();

function wrapped() {
  for (const [place, whole] of writtenOut) place.replaceWith(whole);
  writtenOut.clear();
  for (const math of document.querySelectorAll(".scroll math[display=block], .scroll td math")) {
    const page = math.closest(".scroll").clientWidth, room = math.closest("td") ? 0.42 * page : page - 40;
    if (math.getBoundingClientRect().width <= room) continue;
    // Down to the row that holds the terms.
    const terms = (node) => (node.localName === "mrow" || node.localName === "math" ? [...node.children] : [node]);
    let parts = terms(math);
    while (parts.length === 1 && parts[0].localName === "mrow") parts = terms(parts[0]);
    const sign = (node) => node.localName === "mo" && ["+", "-", "−", "="].includes(node.textContent.trim());
    const wide = (node) => node.getBoundingClientRect().width > 0.8 * room;
    const sum = (node) => node.localName === "mrow" && (wide(node) || ([...node.children].some(sign) && node.firstElementChild.textContent !== "("));
    while (parts.some(sum)) parts = parts.flatMap((part) => (sum(part) ? terms(part) : [part]));
    // A sign and what follows up to the next one stay together.
    const pieces = [[]];
    for (const part of parts) {
      if (sign(part) && pieces[pieces.length - 1].length) pieces.push([]);
      pieces[pieces.length - 1].push(part);
    }
    const lines = [[]];
    let used = 0;
    for (const piece of pieces) {
      const width = piece.reduce((sum, node) => sum + node.getBoundingClientRect().width + 6, 0);
      if (lines[lines.length - 1].length && used + width > room) {
        lines.push([]);
        used = 48;
      }
      lines[lines.length - 1].push(...piece);
      used += width;
    }
    const place = html("div", { class: "long" });
    for (const line of lines) {
      const row = document.createElementNS(math.namespaceURI, "math");
      row.setAttribute("display", "block");
      row.append(...line.map((node) => node.cloneNode(true)));
      place.append(row);
    }
    math.replaceWith(place);
    writtenOut.set(place, math);
  }
}
