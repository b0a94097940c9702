// Search in pages that are opened as files: a browser starts no worker there. A hidden frame then does its work.
if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(url) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      document.body.append(frame);
      const inner = frame.contentWindow;
      const waiting = [];
      this.pass = (data) => waiting.push(data);
      inner.postMessage = undefined;
      const load = (source) => new Promise((done, failed) => {
        const script = inner.document.createElement("script");
        script.src = source;
        script.onload = done;
        script.onerror = failed;
        inner.document.body.append(script);
      });
      inner.importScripts = (...sources) =>
        sources.reduce((before, source) => before.then(() => load(new URL(source, url))), Promise.resolve());
      inner.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", { data }));
      load(url).then(() => {
        this.pass = (data) => inner.dispatchEvent(new MessageEvent("message", { data }));
        waiting.forEach((data) => this.pass(data));
      });
    }
    postMessage(data) { this.pass(data); }
    terminate() {}
  };
}
