// SPDX-License-Identifier: Apache-2.0
// Searches the site in the page itself: the index is a script, so that it also works from a folder, where browsers allow
// neither workers nor requests. Replaces the search/main.js of MkDocs; lunr.js is MkDocs' own.
(function () {
    "use strict";
    const field = document.getElementById("mkdocs-search-query");
    const list = document.getElementById("mkdocs-search-results");
    if (!field || !list) return; // only search.html has results

    const load = (name) => new Promise((done, failed) => {
        const script = document.createElement("script");
        script.src = base_url + "/search/" + name;
        script.onload = done;
        script.onerror = () => failed(new Error("search: cannot load " + name));
        document.head.appendChild(script);
    });

    /** The text around the first word that was found. */
    function summary(text, words) {
        const lower = text.toLowerCase();
        const at = words.map((word) => lower.indexOf(word)).filter((place) => place >= 0);
        const from = Math.max(0, (at.length ? Math.min(...at) : 0) - 80);
        return (from > 0 ? "... " : "") + text.slice(from, from + 240) + (text.length > from + 240 ? " ..." : "");
    }

    function show(found, pages, words) {
        list.textContent = found.length ? "" : "Nothing found";
        for (const each of found.slice(0, 40)) {
            const page = pages.get(each.ref);
            const article = document.createElement("article");
            const link = document.createElement("a");
            link.href = base_url + "/" + page.location;
            link.textContent = page.title;
            const title = document.createElement("h3");
            title.appendChild(link);
            const text = document.createElement("p");
            text.textContent = summary(page.text, words);
            article.append(title, text);
            list.appendChild(article);
        }
    }

    function start() {
        const pages = new Map(window.searchPages.map((page) => [page.location, page]));
        const index = lunr(function () {
            this.ref("location");
            this.field("title", { boost: 10 });
            this.field("text");
            for (const page of window.searchPages) this.add(page);
        });
        const search = () => {
            const words = field.value.toLowerCase().split(/[^\p{L}\p{N}_]+/u).filter((word) => word.length > 1);
            if (!words.length) return void (list.textContent = "");
            // words as they are, stemmed, and as the beginnings of longer ones
            const all = (query) => words.forEach((word) => {
                query.term(lunr.stemmer(new lunr.Token(word)).toString(), { boost: 10 });
                query.term(word, { wildcard: lunr.Query.wildcard.TRAILING, usePipeline: false });
            });
            show(index.query(all), pages, words);
        };
        field.addEventListener("input", search);
        field.value = new URLSearchParams(window.location.search).get("q") || "";
        search();
    }

    load("lunr.js").then(() => load("search_index.js")).then(start).catch((error) => {
        list.textContent = error.message;
        console.error(error.message);
    });
})();
