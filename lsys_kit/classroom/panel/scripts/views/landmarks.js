// Names of landmarks, by which a reader goes from one part of a page to another: no two are called alike.

export function ownName(root, name) {
  const others = new Set(Array.from(document.querySelectorAll("[role=region][aria-label], section[aria-label]"), (each) => each !== root && each.getAttribute("aria-label")));
  let found = name;
  for (let number = 2; others.has(found); number++) found = `${name} (${number})`;
  return found;
}
