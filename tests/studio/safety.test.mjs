// Other sites in the same browser, and other programs, get nothing.
import assert from 'node:assert/strict';
import { createServer, request } from 'node:http';
import { connect } from 'node:net';
import { networkInterfaces } from 'node:os';
import { test } from 'node:test';
import { cross } from './drawings.mjs';
import { patience, run, startStudio } from './support.mjs';
import { tabOf } from './tabs.mjs';

// A request with any headers, which fetch would not send.
const raw = (studio, { method = 'GET', path = '/api/about', headers = {}, body = '' } = {}) =>
  new Promise((resolve, reject) => {
    const asked = request({ host: '127.0.0.1', port: studio.port, method, path, headers: { 'Content-Length': Buffer.byteLength(body), ...headers } }, (answer) => {
      let text = '';
      answer.on('data', (part) => (text += part));
      answer.on('end', () => resolve({ status: answer.statusCode, headers: answer.headers, text }));
    });
    asked.on('error', reject);
    asked.end(body);
  });

test('without the token, or from elsewhere, every address of the API refuses', async (t) => {
  const studio = await startStudio(t), good = { 'X-Inkgrid-Token': studio.token };
  assert.equal((await raw(studio, { headers: good })).status, 200);
  const opened = JSON.parse((await raw(studio, { method: 'POST', path: '/api/documents?name=a.png', headers: good, body: '' })).text);
  assert.match(opened.sentence, /a\.png/);
  const document = await (await studio.ask('/api/documents?name=a.png', { method: 'POST', body: cross() })).json();
  const place = `/api/documents/${document.id}`;
  const addresses = ['/api/about', '/api/nothing', place, `${place}/pixels`, `${place}/file`, `${place}/layers/ink?revision=1`, `${place}/anchors/0?revision=1`].map((path) => ({ path }))
    .concat(['/api/documents', '/api/samples/fox.png', `${place}/solve`, `${place}/export/svg`].map((path) => ({ path, method: 'POST' })), { path: place, method: 'DELETE' });
  const wrong = [
    {}, { 'X-Inkgrid-Token': '' }, { 'X-Inkgrid-Token': studio.token.slice(0, -1) }, { 'X-Inkgrid-Token': `${studio.token}0` }, { Cookie: `token=${studio.token}` },
    { ...good, Origin: 'http://evil.example' }, { ...good, Origin: 'null' }, { ...good, Origin: `http://127.0.0.1:${studio.port + 1}` },
    { ...good, Origin: `https://127.0.0.1:${studio.port}` }, { ...good, Host: 'evil.example' }, { ...good, Host: `evil.example:${studio.port}` },
    { ...good, Host: `127.0.0.1.evil.example:${studio.port}` }, { ...good, Host: '127.0.0.1' }, { ...good, 'Sec-Fetch-Site': 'cross-site' }, { ...good, 'Sec-Fetch-Site': 'same-site' },
  ];
  for (const address of addresses)
    for (const headers of wrong) {
      const answer = await raw(studio, { ...address, headers });
      assert.equal(answer.status, 403, `${address.path} ${JSON.stringify(headers)}`);
      assert.equal(answer.headers['access-control-allow-origin'], undefined);
    }
  assert.equal((await studio.ask(place)).status, 200, 'the drawing is still open');
});

test('every answer carries the headers that keep the page to itself', async (t) => {
  const studio = await startStudio(t);
  for (const path of ['/', '/page/main.js', '/api/about', '/nothing']) {
    const { headers } = await raw(studio, { path });
    assert.match(headers['content-security-policy'], /default-src 'none'; script-src 'self';.*frame-ancestors 'none'/, path);
    assert.doesNotMatch(headers['content-security-policy'], /unsafe/);
    assert.equal(headers['x-content-type-options'], 'nosniff');
    assert.equal(headers['cross-origin-resource-policy'], 'same-origin');
  }
});

test('the server is reached from this machine only, on the port that is asked for', { timeout: patience }, async (t) => {
  const studio = await startStudio(t);
  assert.match(studio.address, /^http:\/\/127\.0\.0\.1:\d+\/#[0-9a-f]{32}$/);
  const elsewhere = Object.values(networkInterfaces()).flat().filter(({ internal, family }) => !internal && family === 'IPv4');
  for (const { address } of elsewhere) await assert.rejects(fetch(`http://${address}:${studio.port}/`, { signal: AbortSignal.timeout(2000) }), address);
  const refused = await run('studio', '--no-browser', '--port', String(studio.port)).catch((problem) => problem);
  assert.equal(refused.code, 1);
  assert.match(refused.stderr, /^inkgrid: [^\n]*port \d+ of '127\.0\.0\.1'[^\n]*\n$/);
  await studio.stop();
  assert.equal((await startStudio(t, '--port', String(studio.port))).port, studio.port);
});

test('no path of the file system is ever opened', async (t) => {
  const studio = await startStudio(t);
  for (const path of ['/page/../../../../etc/passwd', '/page/%2e%2e%2f%2e%2e%2fetc%2fpasswd', '//etc/passwd', '/samples/..%2f..%2fetc%2fpasswd', '/page/']) {
    const { status, text } = await raw(studio, { path });
    assert.equal(status, 404, path);
    assert.doesNotMatch(text, /root:/);
  }
  const answer = await studio.ask('/api/documents?name=%2Fetc%2Fpasswd', { method: 'POST', body: '' });
  assert.equal(answer.status, 400);
  assert.doesNotMatch(await answer.text(), /root:/);
});

test('too large an upload and too large a drawing are refused', async (t) => {
  const studio = await startStudio(t);
  const bomb = Buffer.from(cross());
  bomb.writeUInt32BE(60_000, 16);
  bomb.writeUInt32BE(60_000, 20);
  const large = await studio.ask('/api/documents?name=bomb.png', { method: 'POST', body: bomb });
  assert.equal(large.status, 400);
  assert.match((await large.json()).sentence, /60000 x 60000 pixels/);
  const socket = connect(studio.port, '127.0.0.1');
  socket.write(`POST /api/documents?name=x HTTP/1.1\r\nHost: 127.0.0.1:${studio.port}\r\nX-Inkgrid-Token: ${studio.token}\r\nContent-Length: 999999999999\r\n\r\n`);
  const first = await new Promise((resolve, reject) => socket.once('data', resolve).once('error', reject));
  socket.destroy();
  assert.match(String(first), /^HTTP\/1\.1 413/);
});

test('a request hidden in the body of a refused one is not answered', async (t) => {
  const studio = await startStudio(t);
  const hidden = `GET /api/about HTTP/1.1\r\nHost: 127.0.0.1:${studio.port}\r\nX-Inkgrid-Token: ${studio.token}\r\n\r\n`;
  const socket = connect(studio.port, '127.0.0.1');
  socket.write(`POST /api/documents HTTP/1.1\r\nHost: evil.example\r\nContent-Length: ${hidden.length}\r\n\r\n${hidden}`);
  let text = '';
  socket.on('data', (part) => (text += part)).on('error', () => {});
  await new Promise((resolve) => socket.once('close', resolve));
  assert.doesNotMatch(text, /200 OK/);
});

test('nonsense is answered in one sentence', async (t) => {
  const studio = await startStudio(t);
  const { id } = await (await studio.ask('/api/documents?name=a.png', { method: 'POST', body: cross() })).json();
  for (const body of ['', 'x', '[]', '{}', '{"format":"inkgrid-project","version":1}', `${'['.repeat(5000)}`, '{"format":"inkgrid-project","version":1,"drawing":{"name":"","data":""},"options":{"spacing":1e999}}']) {
    const answer = await studio.ask(`/api/documents/${id}/solve?revision=1`, { method: 'POST', body });
    assert.equal(answer.status, 400, body.slice(0, 40));
    assert.match((await answer.json()).sentence, /^[^\n]{10,300}$/);
  }
  for (const path of [`/api/documents/${id}/layers/ink?revision=9`, `/api/documents/${id}/anchors/0?revision=9`]) assert.equal((await studio.ask(path)).status, 204);
  assert.equal((await studio.ask(`/api/documents/${id}/export/svg?revision=9`, { method: 'POST', body: '{}' })).status, 409);
  assert.equal((await studio.ask('/api/documents/0123')).status, 404);
});

// What a page of another site tries; what it could read or do comes back as texts.
async function attack(target, id) {
  const got = [];
  const tries = [
    ...['cors', 'no-cors'].flatMap((mode) => ['/', '/api/about', `/api/documents/${id}`, `/api/documents/${id}/pixels`].map((path) => async () => {
      const answer = await fetch(target + path, { mode, credentials: 'include' });
      return answer.type === 'opaque' ? '' : await answer.text();
    })),
    async () => (await fetch(`${target}/api/documents/${id}`, { method: 'DELETE' })).status,
    async () => (await fetch(`${target}/api/documents/${id}`, { method: 'DELETE', mode: 'no-cors' })).status || '',
    async () => (await fetch(`${target}/api/documents/${id}/solve`, { method: 'POST', mode: 'no-cors', body: '{}' })).status || '',
    async () => (await import(`${target}/page/main.js`)) && 'imported the page',
    () => new Promise((resolve) => {
      const frame = document.createElement('iframe');
      frame.onload = () => {
        try {
          resolve(frame.contentDocument?.getElementById('stage') ? 'framed the page' : '');
        } catch {
          resolve('');
        }
      };
      frame.src = `${target}/`;
      document.body.append(frame);
    }),
    () => new Promise((resolve) => {
      const image = new Image();
      image.onload = () => resolve('loaded a sample');
      image.onerror = () => resolve('');
      image.src = `${target}/samples/fox.png`;
    }),
    () => new Promise((resolve) => {
      const form = Object.assign(document.createElement('form'), { method: 'POST', action: `${target}/api/samples/fox.png`, target: 'sink' });
      const sink = Object.assign(document.createElement('iframe'), { name: 'sink' });
      sink.onload = () => resolve('');
      document.body.append(sink, form);
      form.submit();
      setTimeout(() => resolve(''), 1000);
    }),
  ];
  for (const attempt of tries) {
    const told = await attempt().catch(() => '');
    if (told) got.push(String(told).slice(0, 200));
  }
  return got;
}

test('a hostile page in the same browser reads nothing and changes nothing', { timeout: patience }, async (t) => {
  const studio = await startStudio(t), tab = await tabOf(t, studio);
  await tab.opened('cross.png', cross());
  const id = await tab.page.evaluate(() => JSON.parse(sessionStorage.getItem('inkgrid-document')).id);
  const site = createServer((_, answer) => answer.writeHead(200, { 'Content-Type': 'text/html' }).end('<!doctype html><title>evil</title>'));
  await new Promise((resolve) => site.listen(0, '127.0.0.1', resolve));
  t.after(() => site.close());
  for (const host of ['127.0.0.1', 'localhost']) {
    const page = await tab.page.context().newPage();
    await page.goto(`http://${host}:${site.address().port}/`);
    assert.deepEqual(await page.evaluate(`(${attack})(${JSON.stringify(studio.origin)}, ${JSON.stringify(id)})`), []);
    await page.close();
  }
  assert.equal((await studio.ask(`/api/documents/${id}`)).status, 200);
  await tab.slide('tolerance', 700);
  await tab.settled();
  assert.equal(await tab.count(), 6);
  assert.deepEqual(tab.faults, []);
});
