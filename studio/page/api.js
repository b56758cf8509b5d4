// The server's addresses.  Every failure is a Problem with one sentence for a person.

export class Problem extends Error {
  constructor(sentence, { status = 0, kind = 'refused' } = {}) {
    super(sentence);
    this.status = status;
    this.kind = kind; // 'refused', 'cancelled', 'changed' (the curves, since), 'gone' (the server does not answer)
  }
}

const isGone = (error) => error instanceof TypeError;

async function problemOf(response) {
  const told = await response.json().catch(() => ({}));
  return new Problem(told.sentence ?? `the server answered ${response.status}`, { status: response.status });
}

// "event: NAME\ndata: JSON\n\n" blocks of a stream of text.
async function* eventsOf(body) {
  const reader = body.pipeThrough(new TextDecoderStream()).getReader();
  let text = '';
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    text += part.value;
    const blocks = text.split('\n\n');
    text = blocks.pop();
    for (const block of blocks) {
      const found = /^event: (\w+)\ndata: ([\s\S]*)$/.exec(block);
      if (found) yield { event: found[1], data: JSON.parse(found[2]) };
    }
  }
}

export class Api {
  constructor(token) {
    this.token = token;
  }

  async ask(path, { method = 'GET', body } = {}) {
    const headers = { 'X-Inkgrid-Token': this.token };
    if (body !== undefined) headers['Content-Type'] = 'application/octet-stream';
    let response;
    try {
      response = await fetch(path, { method, body, headers });
    } catch (error) {
      throw isGone(error) ? new Problem('the studio’s server does not answer', { kind: 'gone' }) : error;
    }
    if (!response.ok) throw await problemOf(response);
    return response;
  }

  async json(path, request) {
    return (await this.ask(path, request)).json();
  }

  async bytes(path, request) {
    return (await this.ask(path, request)).arrayBuffer();
  }

  about() {
    return this.json('/api/about');
  }
  open(name, blob) {
    return this.json(`/api/documents?name=${encodeURIComponent(name)}`, { method: 'POST', body: blob });
  }
  openSample(name) {
    return this.json(`/api/samples/${name}`, { method: 'POST', body: '' });
  }
  document(id) {
    return this.json(`/api/documents/${id}`);
  }
  pixels(id) {
    return this.bytes(`/api/documents/${id}/pixels`);
  }
  file(id) {
    return this.bytes(`/api/documents/${id}/file`);
  }
  cancel(id, revision) {
    return this.ask(`/api/documents/${id}/solve?revision=${revision}`, { method: 'DELETE' });
  }
  // Of the curves of that revision.
  async shown(path) {
    const response = await this.ask(path);
    if (response.status === 204) throw new Problem('the curves have just changed: try again', { kind: 'changed' });
    return response;
  }
  async layer(id, revision, name) {
    return (await this.shown(`/api/documents/${id}/layers/${name}?revision=${revision}`)).arrayBuffer();
  }
  async anchors(id, revision, curve) {
    return (await this.shown(`/api/documents/${id}/anchors/${curve}?revision=${revision}`)).json();
  }
  async exported(id, revision, format, options) {
    const path = `/api/documents/${id}/export/${format}?revision=${revision}`;
    return (await this.ask(path, { method: 'POST', body: JSON.stringify(options) })).blob();
  }

  // The curves of a state; `progress(stage, fraction)` on the way.
  async solve(id, revision, state, progress) {
    const path = `/api/documents/${id}/solve?revision=${revision}`;
    const response = await this.ask(path, { method: 'POST', body: JSON.stringify(state) });
    try {
      for await (const { event, data } of eventsOf(response.body)) {
        if (event === 'progress') progress(data.stage, data.fraction);
        else if (event === 'done') return data;
        else throw new Problem(data.sentence, { kind: event === 'cancelled' ? 'cancelled' : 'refused' });
      }
    } catch (error) {
      throw isGone(error) ? new Problem('the studio’s server has stopped', { kind: 'gone' }) : error;
    }
    throw new Problem('the studio’s server has stopped', { kind: 'gone' });
  }
}
