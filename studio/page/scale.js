// A slider's place, 0..1, to an option's value and back: wide ranges get room where the small values are.

export function scaleOf({ kind, least, most }) {
  if (kind === 'whole' || most - least <= 1) return linear(least, most);
  if (least > 0 && most / least >= 20) return logarithmic(least, most);
  if (least === 0 && most >= 5 && most < 200) return powered(most, 2.5);
  if (least === 0 && most >= 1000) return powered(most, 6);
  return linear(least, most);
}

const linear = (least, most) => ({
  value: (place) => least + place * (most - least),
  place: (value) => (value - least) / (most - least),
});

const logarithmic = (least, most) => ({
  value: (place) => least * (most / least) ** place,
  place: (value) => Math.log(value / least) / Math.log(most / least),
});

const powered = (most, power) => ({
  value: (place) => most * place ** power,
  place: (value) => (value / most) ** (1 / power),
});

// Three digits are as fine as a hand on a slider.
export function rounded(option, value) {
  if (option.kind === 'whole' || option.most === 255) return Math.round(value);
  const digits = Math.max(0, 2 - Math.floor(Math.log10(Math.abs(value) || 1)));
  return Number(Math.min(option.most, Math.max(option.least, value)).toFixed(Math.min(6, digits)));
}
