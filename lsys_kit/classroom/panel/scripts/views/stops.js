// Where a slider stops: of its values those that a hand can tell apart on the pixels that it has. What lies between two stops is
// reached by keys, by a movement with Shift, in the number box, and by the buttons beside it.

// The places of the stops among numbers that increase: those of `kept` and both ends; and of the others every one, every second,
// fifth, tenth, ..., at least every `least`, until there are no more than `most`. Of numbers with equal distances the roundest stay.
export function stopsOf(numbers, kept, most, least = 1) {
  const last = numbers.length - 1, always = new Set([0, last, ...kept]), isRound = roundOf(numbers);
  for (const stride of strides()) {
    if (stride < least) continue;
    const found = numbers.flatMap((_, at) => (always.has(at) || isRound(at, stride) ? [at] : []));
    if (found.length <= most || stride > last) return found;
  }
}

function* strides() {
  for (let power = 1; ; power *= 10) yield* [power, 2 * power, 5 * power];
}

// Whether a place stays where every so many do. The first value of a model and the end of its range may lie between equal distances.
function roundOf(numbers) {
  const gaps = numbers.slice(1).map((number, i) => number - numbers[i]), apart = Math.max(...gaps);
  const isWhole = (number) => Math.abs(number - Math.round(number)) < 1e-6;
  if (gaps.filter((gap) => isWhole(gap / apart)).length < gaps.length - 3) return (at, stride) => at % stride === 0;
  const origin = isWhole(numbers[0] / apart) ? 0 : numbers[0];
  return (at, stride) => isWhole((numbers[at] - origin) / (apart * stride));
}

// Where among the stops a place lies: a whole number at a stop, a fraction between two.
export function amongStops(stops, at) {
  const next = stops.findIndex((stop) => stop >= at), before = stops[next - 1];
  return stops[next] === at ? next : next - (stops[next] - at) / (stops[next] - before);
}
