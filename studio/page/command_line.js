// The command that makes the same curves.

import { isPlain } from './project.js';

const quoted = (word) => (/^[\w./:-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);

export const baseName = (name) => (name.split('/').pop() || 'drawing').replace(/\.[^.]*$/, '') || 'drawing';

export function commandLine(project, table) {
  const { name } = project.drawing;
  const output = quoted(`${baseName(name)}.svg`);
  if (!isPlain(project)) return `inkgrid --project ${quoted(`${baseName(name)}.inkgrid`)} -o ${output}`;
  const options = table.filter((option) => option.name in project.options).map((option) => `--${option.name} ${project.options[option.name]}`);
  return ['inkgrid', quoted(name), ...options, '-o', output].join(' ');
}
