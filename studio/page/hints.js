// The sentence about what the pointer or the focus is on.

const sentenceOf = (target) => {
  const place = target.closest?.('[data-hint], .option, .layer');
  return place?.dataset.hint ?? place?.querySelector('.help')?.textContent ?? '';
};

// Readers of the screen have the sentences as descriptions of the controls.
export function showHints(place) {
  for (const kind of ['pointerover', 'focusin']) document.addEventListener(kind, (event) => (place.textContent = sentenceOf(event.target)));
}
