// A project as the server's project file has it, without the bytes of the drawing.  Nothing here changes one: each function returns another.

export function withOption(project, name, value) {
  const options = { ...project.options };
  if (value === undefined) delete options[name];
  else options[name] = value;
  return { ...project, options };
}

export const withoutOptions = (project) => ({ ...project, options: {} });

export const withScribble = (project, scribble) => ({ ...project, scribbles: [...project.scribbles, scribble] });

export const withoutScribbles = (project) => ({ ...project, scribbles: [] });

export const withEdit = (project, edit) => ({ ...project, edits: [...project.edits, edit] });

export const isPlain = (project) => project.scribbles.length === 0 && project.edits.length === 0 && !project.mask;

// Asks the same of the drawing: a stroke that rested before it was lifted is asked for twice.
export const sameProject = (a, b) =>
  a.options === b.options && a.edits === b.edits && a.mask === b.mask && a.scribbles.length === b.scribbles.length && a.scribbles.every((scribble, i) => scribble === b.scribbles[i]);

const base64 = (blob) =>
  new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(reader.result.slice(reader.result.indexOf(',') + 1));
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(blob);
  });

// The file that `inkgrid --project` reads.
export async function projectFile(project, drawing) {
  const whole = { ...project, drawing: { ...project.drawing, data: await base64(drawing) } };
  return new Blob([JSON.stringify(whole), '\n'], { type: 'application/json' });
}
