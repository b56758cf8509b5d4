// The tools' pictures, strokes on a square of 24.

const kPaths = {
  hand: 'M12 3v18M3 12h18M12 3l-3 3M12 3l3 3M12 21l-3-3M12 21l3-3M3 12l3-3M3 12l3 3M21 12l-3-3M21 12l-3 3',
  erase: 'M8.5 20h12M4 15l9.5-10.5 6.5 6L11.5 20H8.5zM8.5 10l6.5 6',
  delete: 'M4 17C8 17 8 7 12 7s4 10 8 10M15 3l5 5M20 3l-5 5',
  split: 'M3 15c3-5 5-6 7-6M14 9c2 1 4 3 7 3M12 3v4M12 17v4M12 10v4',
  join: 'M3 16c3-6 5-7 7-7M14 15c2 0 4-1 7-7M10 9l4 6',
};
const kName = 'http://www.w3.org/2000/svg';

// Null where the stylesheet draws it.
export function icon(name) {
  if (!kPaths[name]) return null;
  const picture = document.createElementNS(kName, 'svg'), path = document.createElementNS(kName, 'path');
  picture.setAttribute('viewBox', '0 0 24 24');
  path.setAttribute('d', kPaths[name]);
  picture.append(path);
  return picture;
}
