// What can be shown over the drawing, in the order of the method.  `recorded`: the server's name of the layer; the others are drawn here.

export const kLayers = [
  { key: 'input', title: 'Drawing', on: true, help: 'What you gave: the grey pixels everything else is made from.' },
  { key: 'scribbles', title: 'Scribbles', on: true, help: 'Where you asked for less simplification (purple) or more (orange); what was solved again there is part of every layer from the band on.' },
  { key: 'ink', title: 'Ink', recorded: 'ink', help: 'Pixels taken for strokes, their middle in yellow; the red dot is as wide as the average stroke.' },
  { key: 'strokes', title: 'Strokes', recorded: 'strokes', help: 'What the method works on: ink (pale) made slimmer (blue) where details are finer than the pen, and the paper between strokes drawn for one line filled in (orange).' },
  { key: 'band', title: 'Band', recorded: 'band', help: 'A narrow mesh around the ink: strokes whose bands meet can see each other.' },
  { key: 'field', title: 'Frame field', recorded: 'field', help: 'Two directions at every point, one of them along the stroke, as smooth as the drawing allows.' },
  { key: 'labels', title: 'Labels and cuts', recorded: 'labels', help: 'Which direction the stroke follows (green or purple), where the map is cut open (orange), where directions turn about a point (red).' },
  { key: 'grid', title: 'Grid', recorded: 'grid', help: 'The whole-number lines of the map, bent back onto the drawing: strokes are drawn onto them, nearby strokes onto one.' },
  { key: 'graph', title: 'Nodes and edges', recorded: 'chains', help: 'The pieces of grid line that strokes follow, and the points where they meet (discs) or end (rings).' },
  { key: 'fills', title: 'Filled areas', on: true, help: 'Areas much wider than a stroke, kept as filled outlines.' },
  { key: 'widths', title: 'Stroke widths', help: 'Each curve as wide as the stroke it was measured on.' },
  { key: 'curves', title: 'Curves', on: true, help: 'The result: smooth curves along the middle of the strokes, a colour each.' },
  { key: 'handles', title: 'Control points', help: 'Where the curves’ Bézier segments join and how they are steered; discs are junctions, rings are free ends.' },
];
