// Starts the page: the token is in the address's fragment, which no server is ever sent.

import { Api } from './api.js';
import { byId } from './dom.js';
import { Studio } from './studio.js';
import { themeSwitch } from './theme.js';

themeSwitch(byId('theme'));
const api = new Api(location.hash.slice(1));
try {
  const studio = new Studio(api, await api.about());
  document.body.removeAttribute('aria-busy');
  await studio.begin();
} catch (problem) {
  document.body.removeAttribute('aria-busy');
  const place = byId('welcome');
  place.replaceChildren(Object.assign(document.createElement('h2'), { id: 'welcome-title', textContent: 'The studio can’t begin' }),
    Object.assign(document.createElement('p'), { className: 'error', textContent: `${problem.message}.` }));
  if (!problem.kind) throw problem;
}
