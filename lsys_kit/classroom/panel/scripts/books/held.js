// The settings that a page without a kernel holds, as lsys_kit/classroom/panel/held.py chooses them: all combinations of some
// sliders, and each other slider alone, while the rest stands at first values.

// `model` has the sliders of constants, and perhaps one of seeds, which has no name; where all seeds are held it has no texts.
export function heldSettings({ constants, seeds = [], seed, together = [] }) {
  const sown = seeds.length > 0, sliders = sown ? [...constants, { name: "", texts: seeds, index: seeds.indexOf(String(seed)) }] : constants;
  const joined = sliders.map((each) => together.includes(each.name)), atFirst = (place, i) => place === sliders[i].index;
  const first = sliders.map((each) => each.index), grid = sliders.reduce((many, each, i) => (joined[i] ? many * each.texts.length : many), 1);

  const placesOf = (asked) => sliders.map((each) => each.texts.indexOf(each.name ? asked.constants[each.name] : String(asked.seed)));

  // The row of the book at some places; -1 where the page holds none.
  function rowAt(places) {
    const away = places.flatMap((place, i) => (atFirst(place, i) || joined[i] ? [] : [i]));
    if (places.includes(-1) || away.length > 1) return -1;
    if (!away.length) return places.reduce((at, place, i) => (joined[i] ? at * sliders[i].texts.length + place : at), 0);
    const [only] = away, before = sliders.slice(0, only).reduce((many, each, i) => (joined[i] ? many : many + each.texts.length - 1), 0);
    if (!places.every((place, i) => i === only || atFirst(place, i))) return -1;
    return grid + before + places[only] - Number(places[only] > first[only]);
  }

  // The places that the page holds after a movement: what was not moved goes back to its first value where it has to.
  function settled(places, before) {
    if (rowAt(places) >= 0) return places;
    const moved = places.map((place, i) => place !== before[i]), some = moved.some((each, i) => each && !joined[i]);
    const back = places.map((place, i) => (moved[i] || (joined[i] && !some) ? place : first[i]));
    return rowAt(back) >= 0 ? back : before;
  }

  const settingsAt = (places) => ({
    constants: Object.fromEntries(constants.map(({ name, texts }, i) => [name, texts[places[i]]])),
    ...(sown && { seed: Number(seeds[places.at(-1)]) }),
  });

  function told(places, back) {
    const gone = sliders.flatMap(({ name, texts }, i) => (places[i] === back[i] ? [] : [`${name || "seed"} = ${texts[back[i]]}`]));
    return gone.length ? { message: `Back at ${gone.join(", ")}`, hint: "This page does not hold all settings together; the line below the sliders says which." } : null;
  }

  return { rowAt, placesOf, settled, settingsAt, told };
}
